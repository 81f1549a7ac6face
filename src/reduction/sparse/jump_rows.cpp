// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/sparse/jump_rows.hpp"

#include <utility>

#include "base/numbers.hpp"
#include "linalg/dense/dense.hpp"

namespace delam {

// A row that the constraints prescribe has no variable. Other jumps that they bind stay variables: expressed by all
// others of an interface, they would fill the matrix.
JumpRows::JumpRows(const BodySystem& bodies, std::int64_t first, std::int64_t count)
    : patterns_(bodies.problem().patterns.size()), row_of_(index(count), -1) {
    const JumpVariables& variables = bodies.variables();
    const std::int64_t trailing = variables.leading - first;
    const std::vector<SolvedEquation> equations = solve_equations(variables);
    for (const SolvedEquation& solved : equations) {
        SparseVector& equation = equations_.emplace_back();
        equation.emplace_back(trailing + solved.pivot, 1.0);
        for (const auto& [t, c] : solved.entries) equation.emplace_back(trailing + t, -c);
        equation_right_.push_back(solved.prescribed);
    }
    std::vector<JumpRow> expressed = express_rows(variables, equations);
    for (std::size_t r = 0; r < expressed.size(); ++r) {
        JumpRow row{{}, variables.row_offset[r]};
        for (const auto& [jump, n] : variables.row[r]) row.unknowns.emplace_back(trailing + variables.kept + jump, n);
        if (expressed[r].prescribed()) row = std::move(expressed[r]);
        const bool plain = row.offset.empty() && row.unknowns.size() == 1 && row.unknowns.front().second == 1.0 &&
                           row_of_[index(row.unknowns.front().first)] < 0;
        if (plain) row_of_[index(row.unknowns.front().first)] = static_cast<std::int64_t>(r);
        plain_.push_back(plain ? row.unknowns.front().first : -1);
        prescribed_.push_back(row.prescribed() ? 1 : 0);
        rows_.push_back(std::move(row));
    }
}

std::vector<double> JumpRows::offsets(std::span<const double> theta) const {
    std::vector<double> o(rows_.size(), 0.0);
    for (std::size_t r = 0; r < rows_.size(); ++r)
        if (!rows_[r].offset.empty()) o[r] = dot(rows_[r].offset, theta);
    return o;
}

}  // namespace delam
