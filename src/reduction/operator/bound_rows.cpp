// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/operator/bound_rows.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"

namespace delam {

namespace {

// Part of the largest prescribed displacement by which they may miss each other: rounding.
constexpr double contradiction = 1e-9;

// Equations  sum of n_i x_i + O theta = 0  for all theta, in echelon form.
class OffsetEquations {
public:
    // Adds an equation; false: it contradicts those before by more than `rounding`.
    bool add(const JumpRow& row, double rounding) {
        std::map<std::int64_t, double> terms(row.unknowns.begin(), row.unknowns.end());
        std::vector<double> offset = row.offset;
        double size = 0.0;
        for (const auto& [i, n] : terms) size = std::max(size, std::abs(n));
        while (const Equation* known = first_known(terms)) {
            const double factor = terms[known->pivot];
            for (const auto& [i, n] : known->row.unknowns) terms[i] -= factor * n;
            terms.erase(known->pivot);
            offset.resize(std::max(offset.size(), known->row.offset.size()), 0.0);
            for (std::size_t p = 0; p < known->row.offset.size(); ++p) offset[p] -= factor * known->row.offset[p];
        }
        Equation equation;
        double largest = dependent_equation * size;
        for (const auto& [i, n] : terms) {
            if (!(std::abs(n) > dependent_equation * size)) continue;
            equation.row.unknowns.emplace_back(i, n);
            if (std::abs(n) > std::abs(largest)) {
                largest = n;
                equation.pivot = i;
            }
        }
        if (equation.row.unknowns.empty()) return max_abs(offset) <= rounding;
        for (auto& [i, n] : equation.row.unknowns) n /= largest;
        for (double& o : offset) o /= largest;
        equation.row.offset = std::move(offset);
        of_unknown_.emplace(equation.pivot, equations_.size());
        equations_.push_back(std::move(equation));
        return true;
    }

private:
    struct Equation {
        std::int64_t pivot = -1;
        JumpRow row;  // 1 at the pivot
    };
    // Returns the oldest equation whose pivot is among the terms; those after it do not bring it back.
    const Equation* first_known(const std::map<std::int64_t, double>& terms) const {
        std::size_t first = equations_.size();
        for (const auto& [i, n] : terms) {
            const auto at = of_unknown_.find(i);
            if (at != of_unknown_.end()) first = std::min(first, at->second);
        }
        return first < equations_.size() ? &equations_[first] : nullptr;
    }

    std::vector<Equation> equations_;
    std::map<std::int64_t, std::size_t> of_unknown_;  // pivots
};

}  // namespace

std::vector<BoundRow> bound_rows(const JumpVariables& v) {
    std::vector<BoundRow> bound;
    std::vector<std::int64_t> row_of(index(v.jumps), -1);
    for (std::size_t r = 0; r < v.row.size(); ++r)
        if (v.row[r].size() == 1 && v.row[r].front().second == 1.0 && v.row_offset[r].empty() &&
            row_of[index(v.row[r].front().first)] < 0)
            row_of[index(v.row[r].front().first)] = static_cast<std::int64_t>(r);
    for (const std::int64_t r : v.bound) {
        const auto at = index(r);
        if (v.row[at].empty()) continue;
        BoundRow row{r, {}, v.row_offset[at]};
        row.offset.resize(v.lift.size(), 0.0);
        for (const auto& [jump, c] : v.row[at]) row.others.push_back(row_of[index(jump)]);
        bound.push_back(std::move(row));
    }
    for (const SolvedEquation& equation : solve_equations(v)) {
        if (equation.pivot < v.kept || equation.entries.empty()) continue;
        BoundRow row{row_of[index(equation.pivot - v.kept)], {}, equation.prescribed};
        for (const auto& [t, c] : equation.entries) row.others.push_back(row_of[index(t - v.kept)]);
        bound.push_back(std::move(row));
    }
    return bound;
}

void refuse_open_bonds(const Problem& problem, const JumpVariables& variables) {
    const bool bonds = std::any_of(problem.interfaces.begin(), problem.interfaces.end(),
                                   [](const InterfaceProperties& own) { return own.bonded; });
    const auto moves = [](const std::vector<double>& offset) { return max_abs(offset) > 0.0; };
    const bool driven = std::any_of(variables.row_offset.begin(), variables.row_offset.end(), moves) ||
                        std::any_of(variables.equations.begin(), variables.equations.end(),
                                    [&](const JumpVariables::Equation& e) { return moves(e.prescribed); });
    if (!bonds || !driven) return;
    const double rounding = contradiction * max_abs(problem.prescribed_matrix());
    const std::vector<JumpRow> rows = express_rows(variables, solve_equations(variables));
    const auto dim = index(problem.mesh->dimension());
    OffsetEquations equations;
    std::size_t pair = 0;
    for (std::size_t i = 0; i < problem.interfaces.size(); ++i) {
        const InterfaceProperties& own = problem.interfaces[i];
        for (std::size_t p = 0; p < own.adhesion.size(); ++p, ++pair)
            for (std::size_t c = 0; own.bonded && c < dim; ++c)
                if (!equations.add(rows[pair * dim + c], rounding))
                    fail(DELAM_ERROR_PROBLEM, "prescribed displacements open interface ", i, " at its pair ", p,
                         ", directly or through bodies that are bonded to both sides, but it is bonded permanently");
    }
}

}  // namespace delam
