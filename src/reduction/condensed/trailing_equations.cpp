// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/condensed/trailing_equations.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/numbers.hpp"
#include "reduction/condensed/elimination.hpp"

namespace delam {

TrailingEquations::TrailingEquations(const JumpVariables& variables, std::int64_t patterns,
                                     const Superelements& skeleton)
    : skeleton_(&skeleton), leading_(variables.leading), kept_variables_(variables.kept), count_(variables.count()) {
    const std::int64_t trailing = variables.trailing();
    const std::vector<SolvedEquation> solved = solve_equations(variables);
    for (const SolvedEquation& equation : solved) pivot_.push_back(equation.pivot);
    role_.assign(index(trailing), -1);
    for (std::size_t i = 0; i < pivot_.size(); ++i) role_[index(pivot_[i])] = -2 - static_cast<std::int64_t>(i);
    for (std::int64_t t = 0; t < trailing; ++t) {
        if (role_[index(t)] < -1) continue;
        role_[index(t)] = static_cast<std::int64_t>(rest_.size());
        rest_.push_back(t);
        if (t < kept_variables_) ++kept_;
    }
    prescribed_ = DenseMatrix(static_cast<std::int64_t>(pivot_.size()), patterns);
    rows_.resize(pivot_.size());
    columns_.resize(rest_.size());
    bound_.assign(rest_.size() - index(kept_), 0);
    for (std::size_t i = 0; i < pivot_.size(); ++i) {
        const auto pivot = static_cast<std::int64_t>(i);
        for (const auto& [t, c] : solved[i].entries) {
            const std::int64_t r = role_[index(t)];
            rows_[i].emplace_back(r, c);
            columns_[index(r)].emplace_back(pivot, c);
            if (r >= kept_) bound_[index(r - kept_)] = 1;
        }
        for (std::int64_t p = 0; p < prescribed_.columns; ++p) prescribed_(pivot, p) = solved[i].prescribed[index(p)];
    }
    express_jump_rows(variables, patterns);
}

void TrailingEquations::express_jump_rows(const JumpVariables& variables, std::int64_t patterns) {
    for (std::size_t r = 0; r < variables.row.size(); ++r) {
        JumpRow row;
        row.offset = variables.row_offset[r];
        std::map<std::int64_t, double> entries;
        for (const auto& [jump, c] : variables.row[r]) {
            const std::int64_t at = role_[index(kept_variables_ + jump)];
            if (at >= 0) {
                entries[at - kept_] += c;
                continue;
            }
            const std::int64_t pivot = -2 - at;
            for (const auto& [j, m] : rows_[index(pivot)])
                if (j >= kept_ && std::abs(m) > dependent_equation) entries[j - kept_] += c * m;
            if (row.offset.empty()) row.offset.assign(index(patterns), 0.0);
            for (std::int64_t p = 0; p < patterns; ++p) row.offset[index(p)] += c * prescribed_(pivot, p);
        }
        for (const auto& [i, c] : entries)
            if (std::abs(c) > dependent_equation) row.unknowns.emplace_back(i, c);
        jump_rows_.push_back(std::move(row));
    }
    row_of_unknown_.assign(rest_.size() - index(kept_), -1);
    for (std::size_t r = 0; r < jump_rows_.size(); ++r) {
        const JumpRow& row = jump_rows_[r];
        if (row.unknowns.size() != 1 || row.unknowns.front().second != 1.0 || !row.offset.empty()) continue;
        std::int64_t& first = row_of_unknown_[index(row.unknowns.front().first)];
        if (first < 0) first = static_cast<std::int64_t>(r);
    }
}

std::vector<double> TrailingEquations::states(std::span<const double> of_unknowns) const {
    std::vector<double> state(skeleton_->variable().size(), 0.0);
    for (std::int64_t i = 0; i < unknowns(); ++i)
        state[index(place(i))] = bound_[index(i)] != 0 ? Elimination::in_zone : of_unknowns[index(i)];
    for (const std::int64_t t : pivot_)
        if (t >= kept_variables_) state[index(skeleton_->place(leading_ + t))] = Elimination::in_zone;
    return state;
}

std::vector<double> TrailingEquations::unknowns_at(std::span<const double> skeleton) const {
    std::vector<double> x(index(unknowns()));
    for (std::int64_t i = 0; i < unknowns(); ++i) x[index(i)] = skeleton[index(place(i))];
    return x;
}

std::vector<std::uint8_t> TrailingEquations::places_of(std::span<const std::uint8_t> wanted) const {
    std::vector<std::uint8_t> places(skeleton_->variable().size(), 0);
    for (std::int64_t i = 0; i < unknowns(); ++i) {
        if (wanted[index(i)] == 0) continue;
        places[index(place(i))] = 1;
        for (const auto& [pivot, m] : columns_[index(kept_ + i)]) places[pivot_place(pivot)] = 1;
    }
    return places;
}

std::vector<double> TrailingEquations::gather(std::span<const double> skeleton,
                                              std::span<const std::uint8_t> wanted) const {
    std::vector<double> of_unknown(index(unknowns()), 0.0);
    for (std::int64_t i = 0; i < unknowns(); ++i) {
        if (wanted[index(i)] == 0) continue;
        of_unknown[index(i)] = skeleton[index(place(i))];
        for (const auto& [pivot, m] : columns_[index(kept_ + i)])
            of_unknown[index(i)] += m * skeleton[pivot_place(pivot)];
    }
    return of_unknown;
}

double TrailingEquations::on_rest(std::span<const double> variables, std::int64_t rest) const {
    double force = variables[index(leading_ + rest_[index(rest)])];
    for (const auto& [pivot, m] : columns_[index(rest)]) force += m * variables[index(leading_ + pivot_[index(pivot)])];
    return force;
}

std::vector<double> TrailingEquations::variables_at(std::span<const double> theta,
                                                    std::span<const double> unknowns) const {
    std::vector<double> rest(rest_.size(), 0.0), v(index(count_), 0.0);
    std::copy(unknowns.begin(), unknowns.end(), rest.begin() + kept_);
    for (std::size_t i = 0; i < rest.size(); ++i) v[index(leading_ + rest_[i])] = rest[i];
    for (std::size_t i = 0; i < pivot_.size(); ++i) {
        double& value = v[index(leading_ + pivot_[i])];
        for (const auto& [j, m] : rows_[i]) value += m * rest[index(j)];
        for (std::size_t p = 0; p < theta.size(); ++p)
            value += prescribed_(static_cast<std::int64_t>(i), static_cast<std::int64_t>(p)) * theta[p];
    }
    return v;
}

std::vector<double> TrailingEquations::variables_of_kept(std::span<const double> kept) const {
    std::vector<double> v(index(count_), 0.0);
    for (std::size_t k = 0; k < kept.size(); ++k) {
        v[index(leading_ + rest_[k])] = kept[k];
        for (const auto& [pivot, m] : columns_[k]) v[index(leading_ + pivot_[index(pivot)])] += m * kept[k];
    }
    return v;
}

}  // namespace delam
