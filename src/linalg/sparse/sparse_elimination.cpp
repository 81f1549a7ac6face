// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/sparse/sparse_elimination.hpp"

#include <algorithm>
#include <cmath>

#include "base/numbers.hpp"

namespace delam {

namespace {
// Coefficients below this part of the largest of their row are rounding. (Measured by verify/bench/constants.py on 250
// random scenes: half and twice decide alike.)
constexpr double cancelled = 1e-10;
}  // namespace

double SparseElimination::reduce(Row& row) const {
    double largest = 0.0, right = max_abs(row.right);
    for (const auto& [variable, c] : row.terms) largest = std::max(largest, std::abs(c));
    std::vector<std::pair<std::int64_t, double>> known;
    while (true) {
        known.clear();
        for (auto term = row.terms.begin(); term != row.terms.end();) {
            if (!solved(term->first)) {
                ++term;
                continue;
            }
            known.emplace_back(*term);
            term = row.terms.erase(term);
        }
        if (known.empty()) break;
        for (const auto& [variable, factor] : known) {
            const Solution& solution = *find(variable);
            for (const auto& [other, c] : solution.terms) {
                row.terms[other] += factor * c;
                largest = std::max(largest, std::abs(factor * c));
            }
            for (std::size_t p = 0; p < row.right.size(); ++p) {
                row.right[p] -= factor * solution.right[p];
                right = std::max(right, std::abs(factor * solution.right[p]));
            }
        }
        std::erase_if(row.terms, [&](const auto& term) { return std::abs(term.second) <= cancelled * largest; });
    }
    std::erase_if(row.terms, [&](const auto& term) { return std::abs(term.second) <= cancelled * largest; });
    return right;
}

void SparseElimination::solve(const Row& row, std::int64_t pivot) {
    const double scale = 1.0 / row.terms.at(pivot);
    Solution solution;
    for (const auto& [variable, c] : row.terms)
        if (variable != pivot) solution.terms.emplace_back(variable, -c * scale);
    for (const double b : row.right) solution.right.push_back(b * scale);
    place_[pivot] = solution_.size();
    solution_.push_back(std::move(solution));
}

// A solution refers only to variables that were free when it was found. The last solution is therefore final, and one
// backward pass makes the others final too.
void SparseElimination::close() {
    for (std::size_t k = solution_.size(); k-- > 0;) {
        Solution& solution = solution_[k];
        if (std::none_of(solution.terms.begin(), solution.terms.end(), [&](const auto& t) { return solved(t.first); }))
            continue;
        Row row;
        for (const auto& [variable, c] : solution.terms) row.terms[variable] += c;
        row.right = solution.right;
        for (double& b : row.right) b = -b;
        reduce(row);
        for (double& b : row.right) b = -b;
        solution.terms.assign(row.terms.begin(), row.terms.end());
        solution.right = std::move(row.right);
    }
}

}  // namespace delam
