// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/sparse/leading_solve.hpp"

#include <algorithm>

#include "base/cancel_scope.hpp"
#include "base/numbers.hpp"
#include "linalg/dense/blas.hpp"
#include "linalg/dense/blas_size.hpp"

namespace delam {

namespace {

constexpr int each = 1;
constexpr double once = 1.0, taken = -1.0, overwrite = 0.0;

// The leading part of a supernode: its columns, with `below` further rows, `rows` apart in memory.
struct Part {
    std::size_t first;  // column
    const double* value;
    const std::int64_t* others;
    int columns, rows, below;
};

Part part_at(const Supernodes& nodes, const double* values, std::int64_t leading, std::size_t s) {
    const std::int64_t first = nodes.first[s], columns = nodes.first[s + 1] - first;
    const std::int64_t rows = nodes.row_start[s + 1] - nodes.row_start[s];
    const std::int64_t* others = nodes.row.data() + nodes.row_start[s] + columns;
    const std::int64_t* end = std::lower_bound(others, others + (rows - columns), leading);
    return {index(first),    values + nodes.value_start[s], others, blas_size(std::min(columns, leading - first)),
            blas_size(rows), blas_size(end - others)};
}

// Rows below the leading part of a supernode that ends beyond it are trailing.
const double* below_of(const Part& p) { return p.value + p.columns; }

void poll(const Part& p) { poll_cancel_reading("solve", static_cast<std::int64_t>(p.columns) * (p.columns + p.below)); }

}  // namespace

void solve_leading_block(const Supernodes& nodes, const double* values, std::int64_t leading, std::span<double> y,
                         std::vector<double>& below) {
    const BlasThreads one;  // it waits for memory, supernode after supernode
    const auto count =
        index(std::lower_bound(nodes.first.begin(), nodes.first.end() - 1, leading) - nodes.first.begin());
    poll_cancel("solve", leading / 64);
    for (std::size_t s = 0; s < count; ++s) {
        const Part p = part_at(nodes, values, leading, s);
        poll(p);
        below.resize(std::max(below.size(), index(p.below)));
        // Few forces are loads or come from an interface: most columns before them stay zero.
        const double* own = y.data() + p.first;
        if (std::all_of(own, own + p.columns, [](double v) { return v == 0.0; })) continue;
        blas::trsv("L", "N", "N", &p.columns, p.value, &p.rows, y.data() + p.first, &each);
        if (p.below == 0) continue;
        blas::gemv("N", &p.below, &p.columns, &once, below_of(p), &p.rows, y.data() + p.first, &each, &overwrite,
                   below.data(), &each);
        for (std::size_t i = 0; i < index(p.below); ++i) y[index(p.others[i])] -= below[i];
    }
    poll_cancel("solve", leading / 64);
    for (std::size_t s = count; s-- > 0;) {
        const Part p = part_at(nodes, values, leading, s);
        poll(p);
        for (std::size_t i = 0; i < index(p.below); ++i) below[i] = y[index(p.others[i])];
        if (p.below > 0)
            blas::gemv("T", &p.below, &p.columns, &taken, below_of(p), &p.rows, below.data(), &each, &once,
                       y.data() + p.first, &each);
        blas::trsv("L", "T", "N", &p.columns, p.value, &p.rows, y.data() + p.first, &each);
    }
}

}  // namespace delam
