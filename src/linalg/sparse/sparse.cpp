// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/sparse/sparse.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"

namespace delam {

// Sorts the triplets by row with a counting sort, which keeps the given order. Within a row, a dense marker finds
// duplicates (Gustavson, ACM TOMS 4, 1978) and only the distinct columns are sorted. The cost is linear in the
// triplets, and every sum runs in the given order.
SparseMatrix from_triplets(std::int64_t rows, std::int64_t columns, std::vector<Triplet> triplets) {
    const auto at = [](std::int64_t i) { return index(i); };
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

    // position of a column's entry in the row; stale if before the row's first
    std::vector<std::int64_t> place(at(columns), -1);
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

SparseMatrix sum(const SparseMatrix& a, const SparseMatrix& b) {
    SparseMatrix m;
    m.rows = a.rows;
    m.columns = a.columns;
    m.start.reserve(a.start.size());
    m.column.reserve(a.column.size() + b.column.size());
    m.value.reserve(a.value.size() + b.value.size());
    for (std::size_t r = 0; r < index(a.rows); ++r) {
        std::size_t i = index(a.start[r]), j = index(b.start[r]);
        const std::size_t i_end = index(a.start[r + 1]), j_end = index(b.start[r + 1]);
        while (i < i_end || j < j_end) {
            const bool of_a = i < i_end && (j == j_end || a.column[i] <= b.column[j]);
            const bool of_b = j < j_end && (i == i_end || b.column[j] <= a.column[i]);
            m.column.push_back(of_a ? a.column[i] : b.column[j]);
            m.value.push_back((of_a ? a.value[i] : 0.0) + (of_b ? b.value[j] : 0.0));
            i += of_a ? 1 : 0;
            j += of_b ? 1 : 0;
        }
        m.start.push_back(static_cast<std::int64_t>(m.column.size()));
    }
    return m;
}

void multiply(const SparseMatrix& a, std::span<const double> x, std::span<double> y) {
    const auto at = [](std::int64_t i) { return index(i); };
    for (std::size_t r = 0; r < at(a.rows); ++r) {
        double sum = 0.0;
        for (std::size_t e = at(a.start[r]); e < at(a.start[r + 1]); ++e) sum += a.value[e] * x[at(a.column[e])];
        y[r] = sum;
    }
}

void multiply_transposed(const SparseMatrix& a, std::span<const double> x, std::span<double> y) {
    const auto at = [](std::int64_t i) { return index(i); };
    std::fill(y.begin(), y.end(), 0.0);
    for (std::size_t r = 0; r < at(a.rows); ++r)
        for (std::size_t e = at(a.start[r]); e < at(a.start[r + 1]); ++e) y[at(a.column[e])] += a.value[e] * x[r];
}

SparseMatrix transpose(const SparseMatrix& a) {
    SparseMatrix t;
    t.rows = a.columns;
    t.columns = a.rows;
    t.start.assign(index(a.columns) + 1, 0);
    for (const std::int64_t c : a.column) ++t.start[index(c) + 1];
    for (std::size_t i = 1; i < t.start.size(); ++i) t.start[i] += t.start[i - 1];
    make_room(t.column, a.column.size());
    make_room(t.value, a.value.size());
    t.column.resize(a.column.size());
    t.value.resize(a.value.size());
    std::vector<std::int64_t> next(t.start.begin(), t.start.end() - 1);
    for (std::int64_t r = 0; r < a.rows; ++r) {
        for (std::int64_t e = a.start[index(r)]; e < a.start[index(r) + 1]; ++e) {
            const auto at = index(next[index(a.column[index(e)])]++);
            t.column[at] = r;
            t.value[at] = a.value[index(e)];
        }
    }
    return t;
}

// Row i of T^T K T gathers the rows of K that variable i moves; a marker finds equal columns (Gustavson, as above).
SparseMatrix congruence(const SparseMatrix& k, const SparseMatrix& t, const Poll& poll) {
    const auto at = [](std::int64_t i) { return index(i); };
    const SparseMatrix tt = transpose(t);
    SparseMatrix m;
    m.rows = m.columns = t.columns;
    m.start.reserve(at(m.rows) + 1);
    make_room(m.column, k.column.size());
    make_room(m.value, k.value.size());
    std::vector<std::int64_t> place(at(m.columns), -1);
    std::vector<std::pair<std::int64_t, double>> row;
    for (std::size_t i = 0; i < at(tt.rows); ++i) {
        if (i % 4096 == 0) call_if_set(poll);
        const auto first = static_cast<std::int64_t>(m.column.size());
        bool sorted = true;
        for (std::size_t s = at(tt.start[i]); s < at(tt.start[i + 1]); ++s) {
            const std::size_t r = at(tt.column[s]);
            for (std::size_t e = at(k.start[r]); e < at(k.start[r + 1]); ++e) {
                const double value = tt.value[s] * k.value[e];
                const std::size_t c = at(k.column[e]);
                for (std::size_t j = at(t.start[c]); j < at(t.start[c + 1]); ++j) {
                    std::int64_t& p = place[at(t.column[j])];
                    if (p >= first) {
                        m.value[at(p)] += value * t.value[j];
                    } else {
                        p = static_cast<std::int64_t>(m.column.size());
                        sorted = sorted && (p == first || m.column.back() < t.column[j]);
                        m.column.push_back(t.column[j]);
                        m.value.push_back(value * t.value[j]);
                    }
                }
            }
        }
        if (!sorted) {
            row.clear();
            for (std::size_t e = at(first); e < m.column.size(); ++e) row.emplace_back(m.column[e], m.value[e]);
            std::sort(row.begin(), row.end());
            for (std::size_t e = 0; e < row.size(); ++e)
                std::tie(m.column[at(first) + e], m.value[at(first) + e]) = row[e];
        }
        m.start.push_back(static_cast<std::int64_t>(m.column.size()));
    }
    return m;
}

}  // namespace delam
