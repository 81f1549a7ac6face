// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/bound_rows.hpp"

#include <algorithm>
#include <cmath>

#include "linalg/echelon.hpp"
#include "reduction/jump_variables.hpp"

namespace delam {

std::vector<BoundRow> bound_rows(const Problem& problem) {
    std::vector<BoundRow> bound;
    if (std::none_of(problem.constraints.begin(), problem.constraints.end(), [](const Constraint& c) { return c.dof.size() > 1; }))
        return bound;
    const JumpVariables v = make_jump_variables(problem);
    const auto equations = static_cast<std::int64_t>(v.equations.size());
    const auto patterns = static_cast<std::int64_t>(problem.patterns.size());
    if (equations == 0) return bound;
    DenseMatrix q(equations, v.trailing()), value(equations, patterns);
    for (std::int64_t i = 0; i < equations; ++i) {
        const JumpVariables::Equation& e = v.equations[static_cast<std::size_t>(i)];
        for (const auto& [t, c] : e.entries) q(i, t) += c;
        for (std::int64_t p = 0; p < patterns; ++p) value(i, p) = e.prescribed[static_cast<std::size_t>(p)];
    }
    const Echelon echelon = reduced_echelon(std::move(q), v.kept, dependent_equation);
    const DenseMatrix offset = multiply(echelon.operations, value);
    std::vector<std::int64_t> row_of(static_cast<std::size_t>(v.jumps), -1);
    for (std::size_t r = 0; r < v.row.size(); ++r)
        if (v.row[r].size() == 1 && v.row[r].front().second == 1.0)
            row_of[static_cast<std::size_t>(v.row[r].front().first)] = static_cast<std::int64_t>(r);
    for (std::size_t i = 0; i < echelon.pivot.size(); ++i) {
        if (echelon.pivot[i] < v.kept) continue;
        BoundRow row{row_of[static_cast<std::size_t>(echelon.pivot[i] - v.kept)], {}, {}};
        for (std::int64_t t = v.kept; t < v.trailing(); ++t)
            if (t != echelon.pivot[i] && std::abs(echelon.rows(static_cast<std::int64_t>(i), t)) > dependent_equation)
                row.others.push_back(row_of[static_cast<std::size_t>(t - v.kept)]);
        for (std::int64_t p = 0; p < patterns; ++p) row.offset.push_back(offset(static_cast<std::int64_t>(i), p));
        if (!row.others.empty()) bound.push_back(std::move(row));
    }
    return bound;
}

}  // namespace delam
