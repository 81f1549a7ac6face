// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/feti/feti.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "base/numbers.hpp"
#include "reduction/feti/feti_solve.hpp"

namespace delam {

Feti::Feti(const Problem& problem, Monitor& monitor)
    : problem_(problem),
      monitor_(monitor),
      parts_(make_parts(problem_, monitor)),
      dual_(std::move(parts_.rows), parts_.subdomains, problem_.options, condensing()),
      loads_(problem_, parts_, dual_, condensing()) {}

Poll Feti::condensing() {
    const auto parts = static_cast<std::int64_t>(parts_.subdomains.size());
    return monitor_.poll_at("condense", parts, parts);
}

void Feti::solve(const Springs& springs, std::span<const double> theta, Response& response) {
    monitor_.progress("displacement", 0, 0);
    FetiSolve(problem_, monitor_, dual_, loads_, springs, theta).run(response);
}

DenseZone* Feti::zone(const Springs& springs, std::span<const std::uint8_t> wanted, bool) {
    if (zone_ == nullptr) zone_ = std::make_unique<FetiZone>(problem_, parts_.subdomains, dual_, loads_, monitor_);
    return zone_->zone(springs, wanted);
}

std::vector<double> Feti::reaction(std::span<const double>, const Response& response) const {
    std::vector<double> force(response.multipliers.end() - dual_.rows().constraint_count, response.multipliers.end());
    for (double& f : force) f = -f;
    return force;
}

std::vector<double> Feti::local_displacement(std::size_t subdomain, std::span<const double> theta,
                                             const Response& response) const {
    const Subdomain& sub = parts_.subdomains[subdomain];
    std::vector<double> f(index(sub.dofs()), 0.0);
    for (std::size_t p = 0; p < theta.size(); ++p)
        if (!loads_.force[p][subdomain].empty()) add_scaled(theta[p], loads_.force[p][subdomain], f);
    const bool loaded = std::any_of(f.begin(), f.end(), [](double v) { return v != 0.0; });
    std::vector<double> on_boundary = loaded ? sub.condense_load(f) : std::vector<double>(sub.boundary.size(), 0.0);
    for (std::size_t i = 0; i < sub.boundary.size(); ++i) {
        const std::size_t d = index(dual_.rows().offset[subdomain]) + i;
        double pull = 0.0;
        for (std::int64_t e = dual_.b_transposed().start[d]; e < dual_.b_transposed().start[d + 1]; ++e)
            pull += dual_.b_transposed().value[index(e)] *
                    response.multipliers[index(dual_.b_transposed().column[index(e)])];
        on_boundary[i] -= pull;
        f[index(sub.boundary[i])] -= pull;
    }
    std::vector<double> u_boundary(sub.boundary.size());
    multiply_symmetric(sub.flexibility, on_boundary, u_boundary);
    std::size_t first = 0;
    for (std::size_t s = 0; s < subdomain; ++s) first += index(parts_.subdomains[s].rigid_count);
    for (std::int64_t k = 0; k < sub.rigid_count; ++k)
        for (std::size_t i = 0; i < u_boundary.size(); ++i)
            u_boundary[i] += sub.rigid_boundary(static_cast<std::int64_t>(i), k) * response.rigid[first + index(k)];
    return sub.extend(u_boundary, f);
}

std::vector<double> Feti::displacement(std::span<const double> theta, const Response& response) const {
    const int dim = problem_.mesh->dimension();
    std::vector<double> u(index(problem_.mesh->node_count() * dim), 0.0);
    for (std::size_t s = 0; s < parts_.subdomains.size(); ++s) {
        poll_cancel("recover", parts_.subdomains[s].dofs() / 16);
        const std::vector<double> local = local_displacement(s, theta, response);
        for (std::size_t i = 0; i < parts_.subdomains[s].nodes.size(); ++i) {
            const std::size_t node = index(parts_.subdomains[s].nodes[i]);
            for (int k = 0; k < dim; ++k)  // copies agree up to the tolerance of the solve: their mean
                u[node * index(dim) + index(k)] +=
                    local[i * index(dim) + index(k)] / static_cast<double>(parts_.copies[node].size());
        }
    }
    for (const NodeTie& tie : problem_.mesh->ties())
        for (const auto& [node, weight] : tie.of)
            for (int k = 0; k < dim; ++k) u[index(tie.node * dim + k)] += weight * u[index(node * dim + k)];
    return u;
}

double Feti::equilibrium_defect(std::span<const double> theta, const Response& response) const {
    const int dim = problem_.mesh->dimension();
    const std::vector<double> u = displacement(theta, response);
    std::vector<double> defect(u.size(), 0.0);
    for (std::size_t s = 0; s < parts_.subdomains.size(); ++s) {
        const Subdomain& sub = parts_.subdomains[s];
        const auto global = [&](std::int64_t local) {
            return index(sub.nodes[index(local / dim)] * dim + local % dim);
        };
        std::vector<double> mine(index(sub.dofs())), force(mine.size());
        for (std::size_t i = 0; i < mine.size(); ++i) mine[i] = u[global(static_cast<std::int64_t>(i))];
        multiply(sub.stiffness, mine, force);
        for (std::size_t p = 0; p < theta.size(); ++p)
            if (!loads_.force[p][s].empty()) add_scaled(-theta[p], loads_.force[p][s], force);
        for (std::size_t i = 0; i < force.size(); ++i) defect[global(static_cast<std::int64_t>(i))] += force[i];
        for (std::size_t i = 0; i < sub.boundary.size(); ++i) {
            const std::size_t d = index(dual_.rows().offset[s]) + i;
            for (std::int64_t e = dual_.b_transposed().start[d]; e < dual_.b_transposed().start[d + 1]; ++e) {
                const std::int64_t row = dual_.b_transposed().column[index(e)];
                if (row >= dual_.rows().jump_count && row < dual_.rows().jump_count + dual_.rows().glue_count)
                    continue;  // inner forces
                defect[global(sub.boundary[i])] +=
                    dual_.b_transposed().value[index(e)] * response.multipliers[index(row)];
            }
        }
    }
    return max_abs(defect);
}

// The rigid modes of subdomains are orthonormal and contain the motions of parts.
void Feti::move(std::span<const double> displacement, std::span<const double> combination, std::span<const double> jump,
                Response& response) const {
    JumpOperator::move(displacement, combination, jump, response);
    const auto dim = index(problem_.mesh->dimension());
    std::size_t at = 0;
    for (const Subdomain& s : parts_.subdomains)
        for (std::int64_t c = 0; c < s.rigid.columns; ++c, ++at)
            for (std::size_t i = 0; i < s.nodes.size(); ++i)
                for (std::size_t k = 0; k < dim; ++k)
                    response.rigid[at] +=
                        s.rigid(static_cast<std::int64_t>(i * dim + k), c) * displacement[index(s.nodes[i]) * dim + k];
}

std::vector<double> Feti::row_stiffness() const {
    const DualRows& rows = dual_.rows();
    std::vector<double> stiffness(index(rows.jump_count), 0.0);
    for (std::size_t r = 0; r < stiffness.size(); ++r) {
        std::map<std::size_t, double> side;  // of each subdomain
        for (std::int64_t e = rows.b.start[r]; e < rows.b.start[r + 1]; ++e) {
            const std::int64_t dof = rows.b.column[index(e)];
            const auto next = std::upper_bound(rows.offset.begin(), rows.offset.end(), dof);
            const auto s = index(next - rows.offset.begin()) - 1;
            const double n = rows.b.value[index(e)];
            const Subdomain& subdomain = parts_.subdomains[s];
            if (subdomain.body >= 0) side[s] += n * n * subdomain.diagonal[index(dof - rows.offset[s])];
        }
        for (const auto& [s, own] : side) stiffness[r] = stiffness[r] > 0.0 ? std::min(stiffness[r], own) : own;
    }
    return stiffness;
}

std::string Feti::description() const {
    std::int64_t largest = 0;
    double bytes = 0.0;
    for (const Subdomain& s : parts_.subdomains) {
        const auto n = static_cast<std::int64_t>(s.boundary.size());
        largest = std::max(largest, n);
        bytes += 8.0 * static_cast<double>(n) * static_cast<double>(n) * (s.schur.rows > 0 ? 2.0 : 1.0);
    }
    const bool controls = parts_.subdomains.back().body < 0;
    return text("total FETI: ", parts_.subdomains.size() - (controls ? 1 : 0), " subdomains",
                controls ? " and control nodes, " : ", ", dual_.rows().jump_count, " jump + ", dual_.rows().glue_count,
                " gluing + ", dual_.rows().constraint_count, " constraint multipliers, coarse problem ",
                dual_.coarse().size(), ", preconditioner ", problem_.options.preconditioner, ", largest boundary ",
                largest, " DOFs, dense blocks ", bytes / 1048576.0, " MiB");
}

}  // namespace delam
