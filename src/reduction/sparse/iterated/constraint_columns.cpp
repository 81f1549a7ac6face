// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/sparse/iterated/constraint_columns.hpp"

#include <algorithm>
#include <utility>

#include "base/numbers.hpp"

namespace delam {

namespace {

double times_row(const SparseVector& row, std::span<const double> x) {
    double sum = 0.0;
    for (const auto& [i, c] : row) sum += c * x[index(i)];
    return sum;
}

}  // namespace

bool ConstraintColumns::set(std::vector<SparseVector> rows, std::int64_t variables,
                            const std::function<void(std::span<const double>, std::span<double>)>& solve,
                            const Poll& poll) {
    rows_ = std::move(rows);
    const auto n = static_cast<std::int64_t>(rows_.size());
    columns_ = DenseMatrix(variables, n);
    gram_ = DenseMatrix(n, n);
    std::vector<double> right(index(variables));
    for (std::int64_t e = 0; e < n; ++e) {
        call_if_set(poll);
        std::fill(right.begin(), right.end(), 0.0);
        for (const auto& [i, c] : rows_[index(e)]) right[index(i)] += c;
        const auto w = std::span<double>(columns_.value).subspan(index(e * variables), right.size());
        solve(right, w);
        for (std::int64_t f = 0; f < n; ++f) gram_(f, e) = times_row(rows_[index(f)], w);
    }
    return factor_definite(gram_, poll);
}

void ConstraintColumns::apply(std::span<double> z) const {
    if (rows_.empty()) return;
    std::vector<double> y;
    for (const SparseVector& row : rows_) y.push_back(times_row(row, z));
    solve_lower(gram_, y);
    solve_lower_transposed(gram_, y);
    for (std::size_t e = 0; e < y.size(); ++e)
        add_scaled(-y[e], std::span<const double>(columns_.value).subspan(e * z.size(), z.size()), z);
}

}  // namespace delam
