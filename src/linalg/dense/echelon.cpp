// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/dense/echelon.hpp"

#include <algorithm>
#include <cmath>

#include "base/numbers.hpp"

namespace delam {

Echelon reduced_echelon(DenseMatrix q, std::int64_t preferred, double tolerance) {
    const std::int64_t rows = q.rows, columns = q.columns;
    DenseMatrix op(rows, rows);
    for (std::int64_t i = 0; i < rows; ++i) {
        double largest = 0.0;
        for (std::int64_t j = 0; j < columns; ++j) largest = std::max(largest, std::abs(q(i, j)));
        const double scale = largest > 0.0 ? 1.0 / largest : 1.0;
        for (std::int64_t j = 0; j < columns; ++j) q(i, j) *= scale;
        op(i, i) = scale;
    }
    std::vector<std::int64_t> pivot_row, pivot;
    std::vector<std::uint8_t> used(index(rows), 0);
    const auto eliminate = [&](std::int64_t begin, std::int64_t end) {
        while (true) {
            std::int64_t at_row = -1, at_column = -1;
            double best = tolerance;
            for (std::int64_t j = begin; j < end; ++j)
                for (std::int64_t i = 0; i < rows; ++i)
                    if (used[index(i)] == 0 && std::abs(q(i, j)) > best) {
                        best = std::abs(q(i, j));
                        at_row = i;
                        at_column = j;
                    }
            if (at_row < 0) return;
            used[index(at_row)] = 1;
            pivot_row.push_back(at_row);
            pivot.push_back(at_column);
            const double inverse = 1.0 / q(at_row, at_column);
            for (std::int64_t j = 0; j < columns; ++j) q(at_row, j) *= inverse;
            for (std::int64_t j = 0; j < rows; ++j) op(at_row, j) *= inverse;
            q(at_row, at_column) = 1.0;
            for (std::int64_t i = 0; i < rows; ++i) {
                const double factor = q(i, at_column);
                if (i == at_row || factor == 0.0) continue;
                for (std::int64_t j = 0; j < columns; ++j) q(i, j) -= factor * q(at_row, j);
                for (std::int64_t j = 0; j < rows; ++j) op(i, j) -= factor * op(at_row, j);
                q(i, at_column) = 0.0;
            }
        }
    };
    eliminate(0, preferred);
    eliminate(preferred, columns);
    Echelon result{std::move(pivot), DenseMatrix(static_cast<std::int64_t>(pivot_row.size()), columns),
                   DenseMatrix(static_cast<std::int64_t>(pivot_row.size()), rows)};
    for (std::size_t k = 0; k < pivot_row.size(); ++k) {
        const auto i = static_cast<std::int64_t>(k);
        for (std::int64_t j = 0; j < columns; ++j) result.rows(i, j) = q(pivot_row[k], j);
        for (std::int64_t j = 0; j < rows; ++j) result.operations(i, j) = op(pivot_row[k], j);
    }
    return result;
}

}  // namespace delam
