// SPDX-License-Identifier: BSD-3-Clause
// Constraints that bind several trailing variables: they express some of them by the rest, after which the energy is
// one of the unknown jumps alone.
#include <cmath>
#include <map>
#include <numeric>

#include "base/numbers.hpp"
#include "reduction/condensed/bulk.hpp"

namespace delam {

// Equations express some trailing variables by the rest; the displacements among the rest are minimised out.
void Bulk::resolve_equations(const Poll& poll) {
    const std::int64_t trailing = variables().trailing(), kept = variables().kept;
    const auto patterns = static_cast<std::int64_t>(problem_.patterns.size());
    const std::vector<SolvedEquation> solved = solve_equations(variables());
    for (const SolvedEquation& equation : solved) pivot_.push_back(equation.pivot);
    std::vector<std::int64_t> place(index(trailing), -1);  // position in rest, or -2 - position in pivot
    for (std::size_t i = 0; i < pivot_.size(); ++i) place[index(pivot_[i])] = -2 - static_cast<std::int64_t>(i);
    for (std::int64_t t = 0; t < trailing; ++t) {
        if (place[index(t)] < -1) continue;
        place[index(t)] = static_cast<std::int64_t>(rest_.size());
        rest_.push_back(t);
        if (t < kept) ++kept_rest_;
    }
    const auto pivots = static_cast<std::int64_t>(pivot_.size()), rest = static_cast<std::int64_t>(rest_.size());
    bound_ = DenseMatrix(pivots, rest);
    prescribed_ = DenseMatrix(pivots, patterns);
    for (std::int64_t i = 0; i < pivots; ++i) {
        for (const auto& [t, c] : solved[index(i)].entries) bound_(i, place[index(t)]) = c;
        for (std::int64_t p = 0; p < patterns; ++p) prescribed_(i, p) = solved[index(i)].prescribed[index(p)];
    }

    if (pivots > 0) substitute_pivots();
    if (kept_rest_ > 0) {
        std::vector<std::int64_t> eliminated(index(kept_rest_)), stay(index(rest - kept_rest_));
        std::iota(eliminated.begin(), eliminated.end(), 0);
        std::iota(stay.begin(), stay.end(), kept_rest_);
        base_ = std::make_unique<Condensation>(energy_, std::move(stay), std::move(eliminated),
                                               std::vector<double>(index(rest), 0.0), poll);
        energy_ = DenseEnergy();
    }
    express_rows(place);
}

// Of the energy in all trailing variables, t_pivot = M r + d theta leaves
//   S_rr + S_rp M + M^T S_pr + M^T S_pp M   and   L_r + M^T L_p - (S_rp + M^T S_pp) d.
void Bulk::substitute_pivots() {
    const auto pick = [](const DenseMatrix& a, std::span<const std::int64_t> r, std::span<const std::int64_t> c) {
        DenseMatrix b(static_cast<std::int64_t>(r.size()), static_cast<std::int64_t>(c.size()));
        for (std::int64_t j = 0; j < b.columns; ++j)
            for (std::int64_t i = 0; i < b.rows; ++i) b(i, j) = a(r[index(i)], c[index(j)]);
        return b;
    };
    std::vector<std::int64_t> all(problem_.patterns.size());
    std::iota(all.begin(), all.end(), 0);
    const DenseMatrix s_pp = pick(energy_.stiffness, pivot_, pivot_), s_pr = pick(energy_.stiffness, pivot_, rest_);
    DenseEnergy reduced{pick(energy_.stiffness, rest_, rest_), pick(energy_.load, rest_, all)};
    const DenseMatrix l_p = pick(energy_.load, pivot_, all);
    DenseMatrix half = multiply(s_pp, bound_);
    for (std::size_t i = 0; i < half.value.size(); ++i) half.value[i] = 0.5 * half.value[i] + s_pr.value[i];
    const DenseMatrix product = multiply_transposed(bound_, half);
    const std::int64_t rest = reduced.rows();
    for (std::int64_t j = 0; j < rest; ++j)
        for (std::int64_t i = 0; i < rest; ++i) reduced.stiffness(i, j) += product(i, j) + product(j, i);
    DenseMatrix right = multiply(s_pp, prescribed_);
    for (std::size_t i = 0; i < right.value.size(); ++i) right.value[i] = l_p.value[i] - right.value[i];
    const DenseMatrix through = multiply_transposed(bound_, right), direct = multiply_transposed(s_pr, prescribed_);
    for (std::size_t i = 0; i < reduced.load.value.size(); ++i)
        reduced.load.value[i] += through.value[i] - direct.value[i];
    energy_ = std::move(reduced);
}

// The rows of the jumps as functions of the unknowns.
void Bulk::express_rows(std::span<const std::int64_t> place) {
    const auto rest = static_cast<std::int64_t>(rest_.size());
    for (std::size_t r = 0; r < variables().row.size(); ++r) {
        const SparseVector& in_jumps = variables().row[r];
        JumpRow row;
        row.offset = variables().row_offset[r];
        std::map<std::int64_t, double> entries;
        for (const auto& [jump, c] : in_jumps) {
            const std::int64_t at = place[index(variables().kept + jump)];
            if (at >= 0) {
                entries[at - kept_rest_] += c;
                continue;
            }
            const std::int64_t pivot = -2 - at;
            for (std::int64_t j = kept_rest_; j < rest; ++j)
                if (const double m = bound_(pivot, j); std::abs(m) > dependent_equation)
                    entries[j - kept_rest_] += c * m;
            if (row.offset.empty()) row.offset.assign(problem_.patterns.size(), 0.0);
            for (std::int64_t p = 0; p < prescribed_.columns; ++p) row.offset[index(p)] += c * prescribed_(pivot, p);
        }
        for (const auto& [i, c] : entries)
            if (std::abs(c) > dependent_equation) row.unknowns.emplace_back(i, c);
        rows_.push_back(std::move(row));
    }
    row_of_unknown_.assign(index(rest - kept_rest_), -1);
    for (std::size_t r = 0; r < rows_.size(); ++r) {
        if (rows_[r].unknowns.size() != 1 || rows_[r].unknowns.front().second != 1.0 || !rows_[r].offset.empty())
            continue;
        std::int64_t& first = row_of_unknown_[index(rows_[r].unknowns.front().first)];
        if (first < 0) first = static_cast<std::int64_t>(r);
    }
}

}  // namespace delam
