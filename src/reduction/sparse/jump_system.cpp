// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/sparse/jump_system.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/cancel_scope.hpp"
#include "base/numbers.hpp"

namespace delam {

namespace {

// The pattern of `a` with these entries in it, zero where they are missing. links: by rows.
SparseMatrix with_entries(SparseMatrix a, const SparseMatrix& links) {
    SparseMatrix out;
    bool missing = false;
    for (std::int64_t r = 0; r < a.rows && !missing; ++r) {
        const auto begin = a.column.begin() + a.start[index(r)], end = a.column.begin() + a.start[index(r) + 1];
        for (std::int64_t e = links.start[index(r)]; e < links.start[index(r) + 1] && !missing; ++e)
            missing = !std::binary_search(begin, end, links.column[index(e)]);
    }
    if (!missing) return a;
    out.rows = a.rows;
    out.columns = a.columns;
    out.column.reserve(a.column.size() + links.column.size());
    out.value.reserve(a.column.size() + links.column.size());
    for (std::int64_t r = 0; r < a.rows; ++r) {
        std::int64_t l = links.start[index(r)];
        const std::int64_t last = links.start[index(r) + 1];
        const auto before = [&](std::int64_t column) {
            for (; l < last && links.column[index(l)] < column; ++l) {
                out.column.push_back(links.column[index(l)]);
                out.value.push_back(0.0);
            }
        };
        for (std::int64_t e = a.start[index(r)]; e < a.start[index(r) + 1]; ++e) {
            before(a.column[index(e)]);
            if (l < last && links.column[index(l)] == a.column[index(e)]) ++l;
            out.column.push_back(a.column[index(e)]);
            out.value.push_back(a.value[index(e)]);
        }
        before(a.columns);
        out.start.push_back(static_cast<std::int64_t>(out.column.size()));
    }
    return out;
}

// All variables of a pair's rows act on each other.
SparseMatrix pair_links(const JumpRows& rows, std::size_t dim, std::int64_t count) {
    std::vector<Triplet> links;
    std::vector<std::int64_t> of_pair;
    for (std::size_t first = 0; first + dim <= rows.size(); first += dim) {
        of_pair.clear();
        for (std::size_t r = first; r < first + dim; ++r)
            for (const auto& [i, n] : rows[r].unknowns) of_pair.push_back(i);
        for (const std::int64_t i : of_pair)
            for (const std::int64_t j : of_pair) links.push_back({i, j, 0.0});
    }
    for (std::int64_t i = 0; i < count; ++i) links.push_back({i, i, 0.0});
    return from_triplets(count, count, std::move(links));
}

}  // namespace

JumpSystem::JumpSystem(const BodySystem& bodies, SparseMatrix transformed, const Poll& poll)
    : limits_(bodies.problem().options.limits),
      matrix_(std::move(transformed)),
      rows_(bodies, 0, matrix_.rows),
      space_(rows_, matrix_.rows) {
    call_if_set(poll);
    matrix_ =
        with_entries(std::move(matrix_), pair_links(rows_, index(bodies.problem().mesh->dimension()), matrix_.rows));
    for (std::int64_t r = 0; r < matrix_.rows; ++r) {
        const auto begin = matrix_.column.begin() + matrix_.start[index(r)],
                   end = matrix_.column.begin() + matrix_.start[index(r) + 1];
        diagonal_.push_back(matrix_.value[index(std::lower_bound(begin, end, r) - matrix_.column.begin())]);
    }
}

JumpSystem::JumpSystem(const BodySystem& bodies)
    : limits_(bodies.problem().options.limits),
      first_(bodies.variables().leading),
      rows_(bodies, first_, bodies.variables().trailing()),
      space_(rows_, bodies.variables().trailing()) {
    matrix_.rows = matrix_.columns = bodies.variables().trailing();
    matrix_.start.assign(index(matrix_.rows) + 1, 0);
    diagonal_.assign(index(matrix_.rows), 0.0);
}

// Adds in place: a copy of the matrix would be one of the largest blocks of memory.
void JumpSystem::with_added(std::span<const Triplet> entries, const std::function<void(const SparseMatrix&)>& use) {
    struct Restored {
        SparseMatrix& matrix;
        std::vector<std::pair<std::size_t, double>> before;
        ~Restored() {
            for (std::size_t k = before.size(); k-- > 0;) matrix.value[before[k].first] = before[k].second;
        }
    } restored{matrix_, {}};
    restored.before.reserve(entries.size());
    for (const Triplet& t : entries) {
        const auto begin = matrix_.column.begin() + matrix_.start[index(t.row)],
                   end = matrix_.column.begin() + matrix_.start[index(t.row) + 1];
        const auto at = index(std::lower_bound(begin, end, t.column) - matrix_.column.begin());
        restored.before.emplace_back(at, matrix_.value[at]);
        matrix_.value[at] += t.value;
    }
    use(matrix_);
}

void JumpSystem::set(std::vector<Zone::Coupling> couplings, std::span<const std::uint8_t> held) {
    std::erase_if(couplings, [&](const Zone::Coupling& c) { return held[index(c.row)] + held[index(c.column)] > 0; });
    couplings_ = std::move(couplings);
    space_.hold(held);
}

void JumpSystem::add_couplings(std::span<const double> x, std::span<double> y) const {
    for (const Zone::Coupling& c : couplings_) rows_.add(index(c.row), c.value * rows_.value(index(c.column), x), y);
}

void JumpSystem::apply(std::span<const double> x, std::span<double> y) const {
    poll_cancel_reading("linear solve", matrix_.entries());
    multiply(matrix_, x, y);
    add_couplings(x, y);
}

// The matrix is symmetric: its rows are its columns.
void JumpSystem::apply_sparse(std::span<const double> x, std::span<double> y) const {
    std::fill(y.begin(), y.end(), 0.0);
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (x[i] == 0.0) continue;
        for (std::int64_t e = matrix_.start[i]; e < matrix_.start[i + 1]; ++e)
            y[index(matrix_.column[index(e)])] += matrix_.value[index(e)] * x[i];
    }
    add_couplings(x, y);
}

void JumpSystem::apply(std::span<const double> x, std::span<double> y, std::span<const std::uint8_t> wanted) const {
    std::fill(y.begin(), y.end(), 0.0);
    for (std::size_t i = 0; i < wanted.size(); ++i)
        if (wanted[i] != 0) y[i] = matrix_row(i, x);
    for (const ReducedSpace::Slave& slave : space_.slaves()) y[index(slave.pivot)] = matrix_row(index(slave.pivot), x);
    add_couplings(x, y);
}

void JumpSystem::apply(std::span<const double> x, std::span<double> y, std::span<double> size) const {
    for (std::size_t i = 0; i < x.size(); ++i) {
        double sum = 0.0, terms = 0.0;
        for (std::int64_t e = matrix_.start[i]; e < matrix_.start[i + 1]; ++e) {
            const double term = matrix_.value[index(e)] * x[index(matrix_.column[index(e)])];
            sum += term;
            terms += std::abs(term);
        }
        y[i] = sum;
        size[i] = terms;
    }
    for (const Zone::Coupling& c : couplings_) {
        const double force = c.value * rows_.value(index(c.column), x);
        for (const auto& [i, n] : rows_[index(c.row)].unknowns) {
            y[index(i)] += n * force;
            size[index(i)] += std::abs(n * force);
        }
    }
}

double JumpSystem::matrix_row(std::size_t i, std::span<const double> x) const {
    double sum = 0.0;
    for (std::int64_t e = matrix_.start[i]; e < matrix_.start[i + 1]; ++e)
        sum += matrix_.value[index(e)] * x[index(matrix_.column[index(e)])];
    return sum;
}

void JumpSystem::multiply_held(std::span<const double> x, std::span<double> y) const {
    std::fill(y.begin(), y.end(), 0.0);
    for (const std::int64_t i : space_.removed()) y[index(i)] = matrix_row(index(i), x);
    for (const SparseVector& terms : space_.binding_terms())
        for (const auto& [i, c] : terms) y[index(i)] = matrix_row(index(i), x);
}

}  // namespace delam
