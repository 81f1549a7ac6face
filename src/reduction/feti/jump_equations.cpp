// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/feti/jump_equations.hpp"

#include <algorithm>
#include <cmath>

#include "base/numbers.hpp"
#include "linalg/sparse/sparse_elimination.hpp"

namespace delam {

std::vector<double> JumpEquations::moved(std::size_t row) const {
    const std::size_t first = index(dual_.rows().count() - dual_.rows().constraint_count);
    std::vector<double> value(patterns_, 0.0);
    if (row >= first) {
        for (std::size_t q = 0; q < patterns_; ++q) value[q] = loads_.prescribed[(row - first) * patterns_ + q];
        return value;
    }
    for (const Scaling::Prescribed& p : dual_.scaling().prescribed_jumps)
        for (std::size_t k = 0; k < p.row.size() && index(p.jump_row) == row; ++k)
            for (std::size_t q = 0; q < patterns_ && index(p.row[k]) >= first; ++q)
                value[q] += p.y[k] * loads_.prescribed[(index(p.row[k]) - first) * patterns_ + q];
    return value;
}

std::vector<double> JumpEquations::gap(std::size_t row) const {
    std::vector<double> value(patterns_, 0.0);
    for (const GapRow& gap : loads_.gaps)
        if (index(gap.row) == row) value[index(gap.pattern)] += gap.value;
    return value;
}

std::vector<double> JumpEquations::prescribed(std::size_t row) const {
    std::vector<double> jump = moved(row);
    add_scaled(1.0, gap(row), jump);
    return jump;
}

// Each equation gives up a free row outside `rows` if it has one: such a row says nothing about the others.
std::vector<JumpEquations::Dependent> JumpEquations::among(std::span<const std::int64_t> rows,
                                                           const std::function<bool(std::size_t)>& free) const {
    const std::int64_t jumps = dual_.rows().jump_count;
    const auto inside = [&](std::int64_t r) { return std::binary_search(rows.begin(), rows.end(), r); };
    SparseElimination equations;
    std::vector<std::int64_t> given_up;
    for (const Scaling::Dependency& dependency : dual_.scaling().dependencies) {
        SparseElimination::Row equation{{}, std::vector<double>(patterns_, 0.0)};
        for (std::size_t k = 0; k < dependency.row.size(); ++k) {
            const auto r = index(dependency.row[k]);
            const bool jumps_freely = dependency.row[k] < jumps && free(r);
            if (jumps_freely) equation.terms[dependency.row[k]] += dependency.z[k];
            if (dependency.row[k] >= jumps || dual_.scaling().prescribed[r] != 0)
                add_scaled(-dependency.z[k], moved(r), equation.right);
            else  // B u = j - g, j = 0 where it is bonded
                add_scaled(dependency.z[k], gap(r), equation.right);
        }
        equations.reduce(equation);
        std::int64_t pivot = -1;
        for (const auto& [r, z] : equation.terms) {
            const bool better = pivot < 0 || (inside(pivot) && !inside(r)) ||
                                (inside(pivot) == inside(r) && std::abs(z) > std::abs(equation.terms.at(pivot)));
            if (better) pivot = r;
        }
        if (pivot < 0) continue;
        equations.solve(equation, pivot);
        if (inside(pivot)) given_up.push_back(pivot);
    }
    equations.close();
    std::sort(given_up.begin(), given_up.end());
    std::vector<Dependent> dependent;
    for (const std::int64_t r : given_up) {
        const SparseElimination::Solution& solution = *equations.find(r);
        JumpRow jump{{solution.terms.begin(), solution.terms.end()}, {}};
        if (max_abs(solution.right) > 0.0) jump.offset = solution.right;
        dependent.push_back({r, std::move(jump)});
    }
    return dependent;
}

}  // namespace delam
