// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/sparse.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "base/error.hpp"
#include "delam/delam.h"

namespace delam {

// Rows by a counting sort, which keeps the order given; within a row, duplicates meet in a dense marker (Gustavson,
// ACM TOMS 4, 1978) and only the distinct columns are sorted. Linear in the triplets, and every sum runs in the order
// given.
SparseMatrix from_triplets(std::int64_t rows, std::int64_t columns, std::vector<Triplet> triplets) {
    const auto at = [](std::int64_t i) { return static_cast<std::size_t>(i); };
    SparseMatrix m;
    m.rows = rows;
    m.columns = columns;

    std::vector<std::int64_t> begin(at(rows) + 1, 0);
    for (const Triplet& t : triplets) {
        if (t.row < 0 || t.row >= rows || t.column < 0 || t.column >= columns)
            fail(DELAM_ERROR_INTERNAL, "matrix entry (", t.row, ", ", t.column, ") outside ", rows, " x ", columns);
        ++begin[at(t.row) + 1];
    }
    for (std::size_t r = 0; r < at(rows); ++r) begin[r + 1] += begin[r];
    std::vector<std::pair<std::int64_t, double>> entry(triplets.size());
    {
        std::vector<std::int64_t> next(begin.begin(), begin.end() - 1);
        for (const Triplet& t : triplets) entry[at(next[at(t.row)]++)] = {t.column, t.value};
    }
    triplets = {};

    std::vector<std::int64_t> place(at(columns), -1);  // of a column's entry in the row; stale if before its first
    m.start.assign(1, 0);
    m.start.reserve(at(rows) + 1);
    std::int64_t filled = 0;
    for (std::size_t r = 0; r < at(rows); ++r) {
        const std::int64_t first = filled;
        for (std::int64_t e = begin[r]; e < begin[r + 1]; ++e) {
            const auto [column, value] = entry[at(e)];
            std::int64_t& p = place[at(column)];
            if (p >= first) {
                entry[at(p)].second += value;
            } else {
                p = filled;
                entry[at(filled++)] = {column, value};
            }
        }
        std::sort(entry.begin() + first, entry.begin() + filled,
                  [](const auto& a, const auto& b) { return a.first < b.first; });
        m.start.push_back(filled);
    }
    m.column.resize(at(filled));
    m.value.resize(at(filled));
    for (std::size_t e = 0; e < at(filled); ++e) std::tie(m.column[e], m.value[e]) = entry[e];
    return m;
}

void multiply(const SparseMatrix& a, std::span<const double> x, std::span<double> y) {
    const auto at = [](std::int64_t i) { return static_cast<std::size_t>(i); };
    for (std::size_t r = 0; r < at(a.rows); ++r) {
        double sum = 0.0;
        for (std::size_t e = at(a.start[r]); e < at(a.start[r + 1]); ++e) sum += a.value[e] * x[at(a.column[e])];
        y[r] = sum;
    }
}

}  // namespace delam
