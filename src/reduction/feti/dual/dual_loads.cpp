// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/feti/dual/dual_loads.hpp"

#include <algorithm>
#include <utility>

#include "base/numbers.hpp"
#include "scene/strain_loads.hpp"

namespace delam {

DualLoads::DualLoads(const Problem& problem, const FetiParts& parts, const DualOperator& op, const Poll& poll)
    : prescribed(problem.prescribed_matrix()),
      gaps(problem.gap_rows()),
      rows_(index(op.rows().count())),
      coarse_(index(op.coarse().size())),
      constraints_(index(op.rows().constraint_count)),
      jumps_(index(op.rows().jump_count)) {
    call_if_set(poll);
    const std::size_t patterns = problem.patterns.size();
    collect(problem, parts);
    jump.assign(patterns, {});
    resultant.assign(patterns, {});
    work = DenseMatrix(static_cast<std::int64_t>(patterns), static_cast<std::int64_t>(patterns));
    for (std::size_t p = 0; p < patterns; ++p) {
        const bool strained = problem.patterns[p].drives == Pattern::Drives::strain;
        if (strained || problem.patterns[p].drives == Pattern::Drives::force) carry(p, strained, parts, op, poll);
    }
}

void DualLoads::collect(const Problem& problem, const FetiParts& parts) {
    const std::size_t patterns = problem.patterns.size();
    const int dim = problem.mesh->dimension();
    force.assign(patterns, std::vector<std::vector<double>>(parts.subdomains.size()));
    for (const NodalForce& f : problem.forces) {
        const NodeCopy& copy = parts.copies[index(f.dof / dim)].front();
        auto& local = force[index(f.pattern)][index(copy.subdomain)];
        if (local.empty()) local.assign(index(parts.subdomains[index(copy.subdomain)].dofs()), 0.0);
        local[index(copy.local * dim + f.dof % dim)] += f.value;
    }
    strain_energy = DenseMatrix(static_cast<std::int64_t>(patterns), static_cast<std::int64_t>(patterns));
    for (std::size_t s = 0; s < parts.subdomains.size() && !problem.eigenstrains.empty(); ++s) {
        StrainLoads own = strain_loads(problem, parts.subdomains[s].body, parts.cells[s], parts.subdomains[s].nodes);
        for (std::size_t p = 0; p < patterns; ++p)
            if (!own.force[p].empty()) force[p][s] = std::move(own.force[p]);
        for (std::size_t i = 0; i < own.energy.size(); ++i) strain_energy.value[i] += own.energy[i];
    }
}

void DualLoads::carry(std::size_t pattern, bool strained, const FetiParts& parts, const DualOperator& op,
                      const Poll& poll) {
    const DualRows& rows = op.rows();
    std::vector<double> boundary(index(rows.boundary_count()), 0.0);
    jump[pattern].assign(index(rows.count()), 0.0);
    resultant[pattern].assign(index(op.coarse().size()), 0.0);
    std::size_t first = 0;
    for (std::size_t s = 0; s < parts.subdomains.size(); ++s) {
        const Subdomain& sub = parts.subdomains[s];
        const auto& f = force[pattern][s];
        if (!f.empty()) {
            const std::vector<double> load = sub.condense_load(f);
            std::vector<double> u(load.size());
            multiply_symmetric(sub.flexibility, load, u);
            std::copy(u.begin(), u.end(), boundary.begin() + rows.offset[s]);
            for (std::int64_t k = 0; k < sub.rigid_count && !strained; ++k)
                for (std::size_t i = 0; i < f.size(); ++i)
                    resultant[pattern][first + index(k)] += sub.rigid(static_cast<std::int64_t>(i), k) * f[i];
            for (std::size_t q = 0; q < force.size(); ++q)
                if (!force[q][s].empty())
                    work(static_cast<std::int64_t>(q), static_cast<std::int64_t>(pattern)) +=
                        dot(sub.condense_load(force[q][s]), u) + sub.interior_work(force[q][s], f);
        }
        first += index(sub.rigid_count);
        call_if_set(poll);
    }
    multiply(rows.b, boundary, jump[pattern]);
}

void DualLoads::Sum::scale(int e) {
    scale_by_power(jump, e);
    scale_by_power(resultant, e);
    scale_by_power(prescribed, e);
    scale_by_power(gap, e);
}

DualLoads::Sum DualLoads::at(std::span<const double> theta) const {
    Sum sum{std::vector<double>(rows_, 0.0), std::vector<double>(coarse_, 0.0), std::vector<double>(constraints_, 0.0),
            std::vector<double>(jumps_, 0.0)};
    for (std::size_t p = 0; p < theta.size(); ++p) {
        if (theta[p] == 0.0) continue;
        for (std::size_t d = 0; d < sum.prescribed.size(); ++d)
            sum.prescribed[d] += prescribed[d * theta.size() + p] * theta[p];
        if (jump[p].empty()) continue;
        add_scaled(theta[p], jump[p], sum.jump);
        add_scaled(theta[p], resultant[p], sum.resultant);
    }
    for (const GapRow& own : gaps) sum.gap[index(own.row)] = own.value * theta[index(own.pattern)];
    for (std::size_t r = 0; r < jumps_; ++r) sum.jump[r] += sum.gap[r];
    const std::size_t first_constraint = rows_ - sum.prescribed.size();
    for (std::size_t d = 0; d < sum.prescribed.size(); ++d) sum.jump[first_constraint + d] -= sum.prescribed[d];
    return sum;
}

}  // namespace delam
