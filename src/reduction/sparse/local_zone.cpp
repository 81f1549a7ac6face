// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/sparse/local_zone.hpp"

#include <algorithm>
#include <utility>

#include "base/numbers.hpp"
#include "linalg/dense/dense.hpp"
#include "reduction/operator/jump_operator.hpp"
#include "reduction/sparse/neighbourhood.hpp"
#include "reduction/sparse/spring_entries.hpp"

namespace delam {

namespace {

constexpr double farthest = 1e4;  // times the largest variable of the state: no equilibrium lies beyond

}  // namespace

LocalZone::LocalZone(const JumpSystem& system, std::int64_t dimension)
    : system_(system), dim_(index(dimension)), barred_(index(system.count()), 0) {
    for (const SparseVector& equation : system.rows().equations())
        for (const auto& [i, c] : equation) barred_[index(i)] = 1;
}

void LocalZone::take_pairs(std::vector<std::uint8_t>& member) {
    const JumpRows& rows = system_.rows();
    std::vector<std::uint8_t> whole(rows.size() / dim_, 1);
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t p = 0; p < whole.size(); ++p) {
            bool in = false, out = false;
            for (std::size_t r = p * dim_; r < (p + 1) * dim_; ++r)
                for (const auto& [i, n] : rows[r].unknowns) (member[index(i)] != 0 ? in : out) = true;
            whole[p] = in && !out ? 1 : 0;
            if (!in || !out) continue;
            changed = true;
            for (std::size_t r = p * dim_; r < (p + 1) * dim_; ++r)
                for (const auto& [i, n] : rows[r].unknowns) member[index(i)] = 0;
        }
    }
    jump_rows_.clear();
    for (std::size_t r = 0; r < whole.size() * dim_; ++r)
        if (whole[r / dim_] != 0) jump_rows_.push_back(static_cast<std::int64_t>(r));
}

bool LocalZone::enter(std::span<const std::uint8_t> wanted, std::span<const double> theta, std::span<const double> load,
                      std::span<const double> state, const Poll& poll) {
    if (state.size() != index(system_.count())) return false;
    const JumpRows& rows = system_.rows();
    std::vector<std::int64_t> seeds;
    for (std::size_t r = 0; r < wanted.size(); ++r)
        if (wanted[r] != 0)
            for (const auto& [i, n] : rows[r].unknowns) seeds.push_back(i);
    const std::vector<std::int64_t> ring = rings(system_.matrix(), seeds, barred_, system_.limits().local_margin);
    std::vector<std::uint8_t> member(ring.size());
    for (std::size_t i = 0; i < ring.size(); ++i) member[i] = ring[i] <= system_.limits().local_margin ? 1 : 0;
    take_pairs(member);
    std::vector<std::int64_t> variables;
    for (std::size_t i = 0; i < member.size(); ++i)
        if (member[i] != 0) variables.push_back(static_cast<std::int64_t>(i));
    if (jump_rows_.empty() ||
        static_cast<double>(variables.size()) > system_.limits().local_largest_part * static_cast<double>(ring.size()))
        return false;
    if (variables != variables_) {
        variables_.clear();
        matrix_ = submatrix(system_.matrix(), variables);
        factor_ = std::make_unique<SparseCholesky>(matrix_, 0, poll);
        variables_ = std::move(variables);
    }
    const SparseMatrix& a = system_.matrix();
    largest_ = max_abs(state);
    state_.clear();
    left_.clear();
    for (const std::int64_t i : variables_) {
        double image = 0.0;
        for (std::int64_t e = a.start[index(i)]; e < a.start[index(i) + 1]; ++e)
            image += a.value[index(e)] * state[index(a.column[index(e)])];
        state_.push_back(state[index(i)]);
        left_.push_back(load[index(i)] - image);
    }
    const std::vector<double> offset = system_.rows().offsets(theta);
    rows_.clear();
    jump_.clear();
    for (const std::int64_t r : jump_rows_) {
        SparseVector own;
        for (const auto& [i, n] : rows[index(r)].unknowns)
            own.emplace_back(std::lower_bound(variables_.begin(), variables_.end(), i) - variables_.begin(), n);
        rows_.push_back(std::move(own));
        jump_.push_back(offset[index(r)] + system_.rows().value(index(r), state));
    }
    return true;
}

void LocalZone::add_row(std::size_t z, double factor, std::span<double> force) const {
    for (const auto& [i, n] : rows_[z]) force[index(i)] += n * factor;
}

double LocalZone::change(std::size_t z, std::span<const double> unknowns) const {
    double sum = 0.0;
    for (const auto& [i, n] : rows_[z]) sum += n * unknowns[index(i)];
    return sum;
}

bool LocalZone::factor(std::span<const Coupling> couplings, std::span<const std::uint8_t> held) {
    couplings_.clear();
    held_as_.assign(rows_.size(), 0.0);
    std::vector<Triplet> entries;
    const auto add = [&](std::size_t z, std::size_t q, double value) {
        for (const auto& [i, a] : rows_[z])
            for (const auto& [j, b] : rows_[q]) entries.push_back({i, j, a * b * value});
    };
    for (std::size_t z = 0; z < rows_.size(); ++z) {
        if (held[z] == 0 || rows_[z].empty()) continue;
        held_as_[z] = held_as * row_diagonal(system_, index(jump_rows_[z]));
        add(z, z, held_as_[z]);
    }
    for (const Coupling& c : couplings) {
        if (held_as_[index(c.row)] != 0.0 || held_as_[index(c.column)] != 0.0) continue;
        couplings_.push_back(c);
        add(index(c.row), index(c.column), c.value);
    }
    SparseMatrix matrix = matrix_;
    add_entries(matrix, entries);
    return factor_->factorise(matrix);
}

Zone::Solution LocalZone::solve(std::span<const double>, std::span<const double> row_force) {
    Solution solution;
    std::vector<double> right = left_;
    for (std::size_t z = 0; z < rows_.size(); ++z) {
        if (held_as_[z] != 0.0)
            add_row(z, -held_as_[z] * jump_[z], right);
        else if (!row_force.empty())
            add_row(z, row_force[z], right);
    }
    for (const Coupling& c : couplings_) add_row(index(c.row), -c.value * jump_[index(c.column)], right);
    solution.unknowns.resize(right.size());
    factor_->solve(right, solution.unknowns);
    // A part that nothing holds any more, which the factor has met by its rounding alone.
    if (!(max_abs(solution.unknowns) <= farthest * std::max(largest_, max_abs(jump_)))) solution.definite = false;
    solution.multiplier.assign(rows_.size(), 0.0);
    for (std::size_t z = 0; z < rows_.size(); ++z)
        if (held_as_[z] != 0.0) solution.multiplier[z] = held_as_[z] * (jump_[z] + change(z, solution.unknowns));
    // The springs that hold rows give way by 1e-8 of what the bodies would: the rows themselves do not.
    for (std::size_t z = 0; z < rows_.size(); ++z)
        if (held_as_[z] != 0.0 && rows_[z].size() == 1)
            solution.unknowns[index(rows_[z][0].first)] = -jump_[z] / rows_[z][0].second;
    return solution;
}

std::vector<double> LocalZone::unknowns_at(std::span<const double>, const Response&) {
    return std::vector<double>(variables_.size(), 0.0);
}

void LocalZone::keep(std::span<const double> unknowns, Response& response) const {
    for (std::size_t k = 0; k < variables_.size(); ++k)
        response.multipliers[index(variables_[k])] = state_[k] + unknowns[k];
}

std::vector<double> LocalZone::jumps(std::span<const double>, std::span<const double> unknowns) const {
    std::vector<double> j = jump_;
    for (std::size_t z = 0; z < j.size(); ++z) j[z] += change(z, unknowns);
    return j;
}

void LocalZone::complete_forces(std::span<const double>, const Solution& solution, std::span<double> row_force) const {
    for (std::size_t z = 0; z < row_force.size(); ++z)
        if (held_as_[z] != 0.0) row_force[z] = solution.multiplier[z];
}

double LocalZone::energy_of(std::span<const double>, std::span<const double> unknowns) {
    std::vector<double> image(unknowns.size());
    multiply(matrix_, unknowns, image);
    return 0.5 * dot(unknowns, image) - dot(left_, unknowns);
}

}  // namespace delam
