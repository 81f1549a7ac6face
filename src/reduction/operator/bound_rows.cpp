// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/operator/bound_rows.hpp"

#include "base/numbers.hpp"

namespace delam {

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

}  // namespace delam
