// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/condensed/front.hpp"

#include <algorithm>

#include "base/numbers.hpp"

namespace delam {

namespace {

// Resizes without values, in the memory that the matrix has.
void resize(DenseMatrix& a, std::int64_t rows, std::int64_t columns) {
    a.rows = rows;
    a.columns = columns;
    a.value.clear();
    make_room(a.value, index(rows * columns));
    a.value.resize(index(rows * columns));
}

void clear(DenseMatrix& a, std::int64_t rows, std::int64_t columns) {
    resize(a, rows, columns);
    std::fill(a.value.begin(), a.value.end(), 0.0);
}

void clear_lower(DenseMatrix& a) {
    for (std::int64_t j = 0; j < a.rows; ++j) std::fill_n(a.value.begin() + j * (a.rows + 1), index(a.rows - j), 0.0);
}

}  // namespace

void TreeFront::put(std::int64_t i, std::int64_t j, double value) {
    const auto e = static_cast<std::int64_t>(out.size());
    if (i < e)
        factor(i, j) += value;
    else if (j < e)
        coupling(j, i - e) += value;
    else
        energy.stiffness(i - e, j - e) += value;
}

bool TreeFront::eliminate(const Poll& poll) {
    if (!factor_definite(factor, poll)) return false;
    solve_lower(factor, coupling, 0, poll);
    subtract_gram(energy.stiffness, coupling, poll);
    eliminate_loads();
    return true;
}

void TreeFront::eliminate_loads() {
    solve_lower(factor, load);
    subtract_product(energy.load, coupling, load);
}

// x_e = L^-T (L^-1 f_e theta - V x_r)
void TreeFront::recover(std::span<const double> theta, std::span<double> skeleton) const {
    std::vector<double> x(out.size(), 0.0), known(left.size()), coupled(x.size());
    if (x.empty()) return;
    for (std::size_t i = 0; i < known.size(); ++i) known[i] = skeleton[index(left[i])];
    multiply(load, theta, x);
    multiply(coupling, known, coupled);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] -= coupled[i];
    solve_lower_transposed(factor, x);
    for (std::size_t i = 0; i < x.size(); ++i) skeleton[index(out[i])] = x[i];
}

void FrontBuilder::open_loads(TreeFront& front, std::int64_t patterns) {
    const auto e = static_cast<std::int64_t>(front.out.size()), r = static_cast<std::int64_t>(front.left.size());
    clear(front.load, e, patterns);
    clear(front.energy.load, r, patterns);
    for (std::int64_t i = 0; i < e; ++i) at_[index(front.out[index(i)])] = i;
    for (std::int64_t i = 0; i < r; ++i) at_[index(front.left[index(i)])] = e + i;
}

// Zero, with the places of its variables in at_. leaf: what is added next, -1: none; it may set all entries itself.
void FrontBuilder::open(TreeFront& front, std::int64_t leaf, std::int64_t patterns) {
    open_loads(front, patterns);
    const auto e = static_cast<std::int64_t>(front.out.size()), r = static_cast<std::int64_t>(front.left.size());
    resize(front.factor, e, e);
    resize(front.coupling, e, r);
    resize(front.energy.stiffness, r, r);
    std::int64_t set = 0;
    if (leaf >= 0)
        for (const std::int64_t p : bodies_.rows(leaf)) set += at_[index(p)] >= 0 ? 1 : 0;
    if (set == e + r) return;
    clear_lower(front.factor);
    clear_lower(front.energy.stiffness);
    std::fill(front.coupling.value.begin(), front.coupling.value.end(), 0.0);
}

void FrontBuilder::add_leaf(TreeFront& front, std::int64_t leaf) const {
    const DenseMatrix& s = bodies_.stiffness(leaf);
    const std::vector<std::int64_t>& rows = bodies_.rows(leaf);
    const auto e = static_cast<std::int64_t>(front.out.size()), r = static_cast<std::int64_t>(front.left.size());
    std::vector<std::int64_t> from(index(e + r), -1);
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (at_[index(rows[i])] >= 0) from[index(at_[index(rows[i])])] = static_cast<std::int64_t>(i);
    const auto copy = [&](std::int64_t column, std::int64_t first, std::int64_t last, double* target) {
        const double* values = s.value.data() + column * s.rows;
        for (std::int64_t i = first; i < last; ++i, ++target)
            if (from[index(i)] >= 0) *target = values[from[index(i)]];
    };
    for (std::int64_t j = 0; j < e; ++j)
        if (from[index(j)] >= 0) copy(from[index(j)], j, e, front.factor.value.data() + j * e + j);
    for (std::int64_t j = 0; j < r; ++j) {
        if (from[index(e + j)] < 0) continue;
        copy(from[index(e + j)], 0, e, front.coupling.value.data() + j * e);
        copy(from[index(e + j)], e + j, e + r, front.energy.stiffness.value.data() + j * r + j);
    }
}

// Entries of T^T K T.
void FrontBuilder::add_entries(TreeFront& front, std::span<const Triplet> entries) const {
    for (const Triplet& entry : entries) {
        const std::int64_t i = at(entry.row), j = at(entry.column);
        if (i >= 0 && j >= 0) front.put(std::max(i, j), std::min(i, j), entry.value);
    }
}

FrontBuilder::Runs FrontBuilder::runs(const TreeFront& front, const TreeFront& other) const {
    const auto e = static_cast<std::int64_t>(front.out.size());
    Runs found;
    for (std::int64_t i = 0; i < static_cast<std::int64_t>(other.left.size()); ++i) {
        const std::int64_t at = at_[index(other.left[index(i)])];
        if (at < 0) continue;
        auto& runs = at < e ? found.out : found.left;
        const std::int64_t to = at < e ? at : at - e;
        if (!runs.empty() && runs.back().from + runs.back().length == i && runs.back().to + runs.back().length == to)
            ++runs.back().length;
        else
            runs.push_back({i, to, 1});
    }
    return found;
}

// The energy that another front has left. Its variables stand here in runs of neighbours, those that are eliminated
// and those that are left each in the same order as there.
void FrontBuilder::add(TreeFront& front, const TreeFront& other) const {
    const auto e = static_cast<std::int64_t>(front.out.size());
    const auto [out, left] = runs(front, other);
    const DenseMatrix& s = other.energy.stiffness;
    // The part of a column from its diagonal on.
    const auto add_columns = [&s](const std::vector<Run>& runs, DenseMatrix& target) {
        for (std::size_t a = 0; a < runs.size(); ++a)
            for (std::int64_t k = 0; k < runs[a].length; ++k) {
                const double* values = s.value.data() + (runs[a].from + k) * s.rows;
                double* sums = target.value.data() + (runs[a].to + k) * target.rows;
                for (std::int64_t i = k; i < runs[a].length; ++i) sums[runs[a].to + i] += values[runs[a].from + i];
                for (std::size_t b = a + 1; b < runs.size(); ++b)
                    for (std::int64_t i = 0; i < runs[b].length; ++i) sums[runs[b].to + i] += values[runs[b].from + i];
            }
    };
    add_columns(out, front.factor);
    add_columns(left, front.energy.stiffness);
    for (const Run& column : left)
        for (std::int64_t k = 0; k < column.length; ++k) {
            double* sums = front.coupling.value.data() + (column.to + k) * e;
            for (const Run& row : out) {
                // The matrix stores the lower triangle: of two equal entries the one there is read.
                const bool below = column.from > row.from;
                const double* values = s.value.data() + (below ? row.from * s.rows + column.from + k
                                                               : (column.from + k) * s.rows + row.from);
                const std::int64_t step = below ? s.rows : 1;
                for (std::int64_t i = 0; i < row.length; ++i) sums[row.to + i] += values[i * step];
            }
        }
    add_loads(front, other);
}

void FrontBuilder::add_loads(TreeFront& front, const TreeFront& other) const {
    const auto [out, left] = runs(front, other);
    for (std::int64_t q = 0; q < other.energy.load.columns; ++q) {
        for (const Run& run : out)
            for (std::int64_t i = 0; i < run.length; ++i)
                front.load(run.to + i, q) += other.energy.load(run.from + i, q);
        for (const Run& run : left)
            for (std::int64_t i = 0; i < run.length; ++i)
                front.energy.load(run.to + i, q) += other.energy.load(run.from + i, q);
    }
}

void FrontBuilder::close(const TreeFront& front) {
    for (const auto* list : {&front.out, &front.left})
        for (const std::int64_t p : *list) at_[index(p)] = -1;
}

}  // namespace delam
