// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/dense/updated_factor.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/numbers.hpp"

namespace delam {

namespace {

// A spring of the reference that is stiffer than this multiple of the bodies' own stiffness is not subtracted.
constexpr double hidden = 1e3;
// Cost of an update beside its multiplications, in multiplications of a full factor: it handles a dozen small matrices.
constexpr double handling = 3e5;
// Multiplications from which on a poll is worth it.
constexpr double long_enough = 1e8;

bool before(const Triplet& a, const Triplet& b) { return a.row != b.row ? a.row < b.row : a.column < b.column; }

std::vector<Triplet> sorted_sums(std::vector<Triplet> springs) {
    std::stable_sort(springs.begin(), springs.end(), before);
    std::size_t last = 0;
    for (std::size_t i = 1; i < springs.size(); ++i) {
        if (before(springs[last], springs[i]))
            springs[++last] = springs[i];
        else
            springs[last].value += springs[i].value;
    }
    if (!springs.empty()) springs.resize(last + 1);
    return springs;
}

}  // namespace

bool BoundUnknowns::binds(std::size_t i) const {
    const std::size_t rows = index(binding.rows);
    const auto column = std::span<const double>(binding.value).subspan(i * rows, rows);
    return std::any_of(column.begin(), column.end(), [](double m) { return m != 0.0; });
}

std::size_t BoundUnknowns::touched() const {
    std::size_t count = bound.size();
    for (std::size_t i = 0; i < free.size(); ++i) count += binds(i) ? 1 : 0;
    return count;
}

bool UpdatedFactor::renew(DenseMatrix& a, const std::vector<Triplet>& springs, std::span<const std::int64_t> free,
                          std::int64_t all, const Poll& poll) {
    ++renewals_;
    definite_ = factor_definite(a, poll);
    if (!definite_) return false;
    valid_ = false;  // unless all of this comes to its end
    std::swap(factor_, a);
    unknowns_.assign(free.begin(), free.end());
    place_.assign(index(all), -1);
    for (std::size_t i = 0; i < unknowns_.size(); ++i) place_[index(unknowns_[i])] = static_cast<std::int64_t>(i);
    springs_ = sorted_sums(springs);
    std::erase_if(springs_,
                  [this](const Triplet& t) { return place_[index(t.row)] < 0 || place_[index(t.column)] < 0; });
    columns_ = DenseMatrix(factor_.rows, 0);
    gram_ = DenseMatrix();
    column_of_.assign(index(all), -1);
    spent_ = 0.0;
    load_.clear();
    free_ = unknowns_;
    k_.clear();
    b_.clear();
    small_free_.clear();
    small_bound_.clear();
    touched_ = 0;
    valid_ = true;
    return true;
}

UpdatedFactor::Change UpdatedFactor::compare(const std::vector<Triplet>& springs, const BoundUnknowns& unknowns) {
    Change change;
    std::vector<std::uint8_t> now(place_.size(), 0), marked(place_.size(), 0);
    for (const auto& set : {unknowns.free, unknowns.bound})
        for (const std::int64_t i : set) {
            now[index(i)] = 1;
            if (place_[index(i)] < 0) change.added.push_back(i);
        }
    std::sort(change.added.begin(), change.added.end());
    for (const std::int64_t i : unknowns.bound) marked[index(i)] = 1;
    for (std::size_t j = 0; j < unknowns.free.size() && !unknowns.bound.empty(); ++j)
        if (unknowns.binds(j)) marked[index(unknowns.free[j])] = 1;
    for (const std::int64_t i : unknowns_)
        if (now[index(i)] == 0) change.held.push_back(i);
    const std::vector<Triplet> next = sorted_sums(springs);
    const auto differ = [&](const Triplet& at, double value) {
        if (value == 0.0 || now[index(at.row)] == 0 || now[index(at.column)] == 0) return;
        change.spring.push_back({at.row, at.column, value});
        marked[index(at.row)] = marked[index(at.column)] = 1;
    };
    auto old = springs_.begin();
    for (const Triplet& t : next) {
        for (; old != springs_.end() && before(*old, t); ++old) differ(*old, -old->value);
        const bool same = old != springs_.end() && !before(t, *old);
        differ(t, same ? t.value - old->value : t.value);
        if (same) ++old;
    }
    for (; old != springs_.end(); ++old) differ(*old, -old->value);
    for (const std::int64_t i : unknowns_)
        if (marked[index(i)] != 0) change.touched.push_back(i);
    return change;
}

bool UpdatedFactor::hides(const DenseMatrix& stiffness, const Change& change) const {
    return std::any_of(change.spring.begin(), change.spring.end(), [&](const Triplet& t) {
        return t.row == t.column && place_[index(t.row)] >= 0 && -t.value > hidden * stiffness(t.row, t.row);
    });
}

double UpdatedFactor::cost(const Change& change) const {
    const auto n = static_cast<double>(factor_.rows);
    double columns = 0.0, missing = 0.0;
    for (const auto* set : {&change.touched, &change.held})
        for (const std::int64_t i : *set) {
            if (column_of_[index(i)] >= 0) continue;
            const double tail = n - static_cast<double>(place_[index(i)]);
            columns += 0.5 * tail * tail;
            missing += 1.0;
        }
    for (const std::int64_t i : change.added) {
        if (column_of_[index(i)] >= 0) continue;
        columns += 0.5 * n * n;
        missing += 1.0;
    }
    const auto u = static_cast<double>(change.touched.size()), k = u + static_cast<double>(change.held.size()),
               b = static_cast<double>(change.added.size());
    const double products = missing * n * (static_cast<double>(columns_.columns) + 0.5 * missing);
    const double small = k * k * (k + b) + (u + b) * (u + b) * (u + b) / 3.0;
    return columns + products + small + 2.0 * n * (static_cast<double>(columns_.columns) + missing);
}

void UpdatedFactor::add_columns(const DenseMatrix& stiffness, const Change& change, const Poll& poll) {
    std::vector<std::int64_t> missing;
    for (const auto* set : {&change.touched, &change.held, &change.added})
        for (const std::int64_t i : *set)
            if (column_of_[index(i)] < 0) missing.push_back(i);
    if (missing.empty()) return;
    DenseMatrix more(factor_.rows, static_cast<std::int64_t>(missing.size()));
    std::int64_t first = factor_.rows;
    for (std::int64_t c = 0; c < more.columns; ++c) {
        const std::int64_t i = missing[index(c)], p = place_[index(i)];
        column_of_[index(i)] = columns_.columns + c;
        first = std::min(first, std::max<std::int64_t>(p, 0));
        if (p >= 0)
            more(p, c) = 1.0;
        else
            for (std::int64_t r = 0; r < more.rows; ++r) more(r, c) = stiffness(unknowns_[index(r)], i);
    }
    const auto tail = static_cast<double>(factor_.rows - first);
    solve_lower(factor_, more, first, tail * tail * static_cast<double>(more.columns) > long_enough ? poll : Poll());
    const std::int64_t old = columns_.columns, all = old + more.columns;
    columns_.value.insert(columns_.value.end(), more.value.begin(), more.value.end());
    columns_.columns = all;
    const DenseMatrix products = multiply_transposed(columns_, more, first);
    DenseMatrix gram(all, all);
    for (std::int64_t j = 0; j < old; ++j)
        std::copy_n(gram_.value.begin() + j * old, old, gram.value.begin() + j * all);
    for (std::int64_t j = old; j < all; ++j)
        for (std::int64_t i = 0; i < all; ++i) gram(i, j) = gram(j, i) = products(i, j - old);
    gram_ = std::move(gram);
}

// The small matrix, factored: [G^-1_UU, (G^-1 H)_UB; ., S_BB - S_B0 A0^-1 S_0B + H^T G^-1 H] and the springs. False:
// the flexibility has no digits.
bool UpdatedFactor::condense(const DenseMatrix& stiffness, const Change& change, const BoundUnknowns& unknowns) {
    const auto k = static_cast<std::int64_t>(k_.size()), b = static_cast<std::int64_t>(b_.size()),
               u = static_cast<std::int64_t>(change.touched.size());
    const auto at = [&](std::int64_t unknown) { return column_of_[index(unknown)]; };
    inverse_ = DenseMatrix(k, k);
    for (std::int64_t j = 0; j < k; ++j)
        for (std::int64_t i = 0; i < k; ++i) inverse_(i, j) = gram_(at(k_[index(i)]), at(k_[index(j)]));
    if (!invert_definite(inverse_)) return false;
    through_ = DenseMatrix(k, b);
    small_ = DenseMatrix(u + b, u + b);
    for (std::int64_t j = 0; j < u; ++j)
        for (std::int64_t i = j; i < u; ++i) small_(i, j) = inverse_(i, j);
    if (b > 0) {
        for (std::int64_t j = 0; j < b; ++j)
            for (std::int64_t i = 0; i < k; ++i) through_(i, j) = gram_(at(k_[index(i)]), at(b_[index(j)]));
        const DenseMatrix image = multiply(inverse_, through_), corner = multiply_transposed(through_, image);
        for (std::int64_t j = 0; j < u; ++j)
            for (std::int64_t i = 0; i < b; ++i) small_(u + i, j) = image(j, i);
        for (std::int64_t j = 0; j < b; ++j)
            for (std::int64_t i = j; i < b; ++i)
                small_(u + i, u + j) =
                    stiffness(b_[index(i)], b_[index(j)]) - gram_(at(b_[index(i)]), at(b_[index(j)])) + corner(i, j);
    }
    std::vector<std::int64_t> row(place_.size(), -1);
    for (std::int64_t i = 0; i < u; ++i) row[index(k_[index(i)])] = i;
    for (std::int64_t i = 0; i < b; ++i) row[index(b_[index(i)])] = u + i;
    for (const Triplet& t : change.spring) small_(row[index(t.row)], row[index(t.column)]) += t.value;
    bind(unknowns, row);
    definite_ = factor_definite(small_);
    return true;
}

// The small matrix without the bound unknowns: S_ff + S_fb M + M^T S_bf + M^T S_bb M. row: of each unknown, -1: none.
void UpdatedFactor::bind(const BoundUnknowns& unknowns, std::span<const std::int64_t> row) {
    small_free_.clear();
    small_bound_.clear();
    if (unknowns.bound.empty()) return;
    std::vector<std::uint8_t> is_bound(index(small_.rows), 0);
    for (const std::int64_t i : unknowns.bound) {
        small_bound_.push_back(row[index(i)]);
        is_bound[index(row[index(i)])] = 1;
    }
    std::vector<std::int64_t> place(is_bound.size(), -1);
    for (std::int64_t i = 0; i < small_.rows; ++i) {
        if (is_bound[index(i)] != 0) continue;
        place[index(i)] = static_cast<std::int64_t>(small_free_.size());
        small_free_.push_back(i);
    }
    const auto bound = static_cast<std::int64_t>(small_bound_.size()),
               free = static_cast<std::int64_t>(small_free_.size());
    small_binding_ = DenseMatrix(bound, free);
    for (std::size_t j = 0; j < unknowns.free.size(); ++j) {
        if (!unknowns.binds(j)) continue;
        for (std::int64_t i = 0; i < bound; ++i)
            small_binding_(i, place[index(row[index(unknowns.free[j])])]) =
                unknowns.binding(i, static_cast<std::int64_t>(j));
    }
    mirror_lower(small_);
    const DenseMatrix all = std::move(small_);
    DenseMatrix corner(bound, bound);
    for (std::int64_t j = 0; j < bound; ++j)
        for (std::int64_t i = 0; i < bound; ++i)
            corner(i, j) = 0.5 * all(small_bound_[index(i)], small_bound_[index(j)]);
    DenseMatrix half = multiply(corner, small_binding_);
    for (std::int64_t j = 0; j < free; ++j)
        for (std::int64_t i = 0; i < bound; ++i) half(i, j) += all(small_bound_[index(i)], small_free_[index(j)]);
    const DenseMatrix product = multiply_transposed(small_binding_, half);
    small_ = DenseMatrix(free, free);
    for (std::int64_t j = 0; j < free; ++j)
        for (std::int64_t i = j; i < free; ++i)
            small_(i, j) = all(small_free_[index(i)], small_free_[index(j)]) + product(i, j) + product(j, i);
}

// Counts U alone: u n^2 / 2 for its columns, u^2 n / 2 for their products, and some u^3; a quarter of n leaves room for
// more.
bool UpdatedFactor::pays(std::size_t unknowns, std::size_t touched) {
    const auto n = static_cast<double>(unknowns);
    return handling <= n * n * n / 3.0 && 4 * touched <= unknowns;
}

bool UpdatedFactor::update(const DenseMatrix& stiffness, const std::vector<Triplet>& springs,
                           const BoundUnknowns& unknowns, const Poll& poll) {
    if (!valid_) return false;
    const Change change = compare(springs, unknowns);
    const auto n = static_cast<double>(unknowns.free.size() + unknowns.bound.size());
    const double more = cost(change);
    if (spent_ + more + handling > n * n * n / 3.0 || hides(stiffness, change)) return false;
    valid_ = false;  // unless all of this comes to its end
    spent_ += more;
    add_columns(stiffness, change, poll);
    free_.assign(unknowns.free.begin(), unknowns.free.end());
    k_ = change.touched;
    k_.insert(k_.end(), change.held.begin(), change.held.end());
    b_ = change.added;
    touched_ = static_cast<std::int64_t>(change.touched.size());
    const bool has_digits = condense(stiffness, change, unknowns);
    valid_ = true;
    return has_digits;
}

void UpdatedFactor::solve_small(std::vector<double>& small) const {
    if (small_bound_.empty()) {
        solve_lower(small_, small);
        solve_lower_transposed(small_, small);
        return;
    }
    std::vector<double> free(small_free_.size()), bound(small_bound_.size());
    for (std::size_t i = 0; i < bound.size(); ++i) bound[i] = small[index(small_bound_[i])];
    multiply_transposed(small_binding_, bound, free);
    for (std::size_t i = 0; i < free.size(); ++i) free[i] += small[index(small_free_[i])];
    solve_lower(small_, free);
    solve_lower_transposed(small_, free);
    multiply(small_binding_, free, bound);
    for (std::size_t i = 0; i < free.size(); ++i) small[index(small_free_[i])] = free[i];
    for (std::size_t i = 0; i < bound.size(); ++i) small[index(small_bound_[i])] = bound[i];
}

// Uses x_K - x_K* + H x_B = G mu:   L^T x_0 = L^-1 g - Y_B x_B + Y_K mu.
void UpdatedFactor::solve(std::span<double> x, bool again) {
    const std::size_t n = unknowns_.size(), k = k_.size(), b = b_.size(), u = index(touched_);
    std::vector<double> w(n, 0.0), other(place_.size(), 0.0);
    for (std::size_t i = 0; i < free_.size(); ++i) {
        const std::int64_t p = place_[index(free_[i])];
        if (p >= 0)
            w[index(p)] = x[i];
        else
            other[index(free_[i])] = x[i];
    }
    if (again && w == load_) {
        w = loaded_;
    } else {
        std::vector<double> load;
        if (again) load = w;
        solve_lower(factor_, w);
        if (again) {
            load_.clear();
            loaded_ = w;
            load_ = std::move(load);
        }
    }
    std::vector<double> on(index(columns_.columns)), along(on.size(), 0.0);
    if (k + b > 0) {
        multiply_transposed(columns_, w, on);
        std::vector<double> star(k), q(k), carried(b), small(u + b), added(b), moved(k);
        for (std::size_t i = 0; i < k; ++i) star[i] = on[index(column_of_[index(k_[i])])];
        multiply(inverse_, star, q);
        multiply_transposed(through_, q, carried);
        std::copy_n(q.begin(), u, small.begin());
        for (std::size_t i = 0; i < b; ++i)
            small[u + i] = other[index(b_[i])] - on[index(column_of_[index(b_[i])])] + carried[i];
        solve_small(small);
        std::copy_n(small.begin() + static_cast<std::ptrdiff_t>(u), b, added.begin());
        multiply(through_, added, moved);
        for (std::size_t i = 0; i < k; ++i) moved[i] += (i < u ? small[i] : 0.0) - star[i];
        multiply(inverse_, moved, q);
        for (std::size_t i = 0; i < k; ++i) along[index(column_of_[index(k_[i])])] = q[i];
        for (std::size_t i = 0; i < b; ++i) along[index(column_of_[index(b_[i])])] = -added[i];
        std::vector<double> more(n);
        multiply(columns_, along, more);
        for (std::size_t i = 0; i < n; ++i) w[i] += more[i];
        for (std::size_t i = 0; i < b; ++i) other[index(b_[i])] = added[i];
    }
    solve_lower_transposed(factor_, w);
    for (std::size_t i = 0; i < free_.size(); ++i) {
        const std::int64_t p = place_[index(free_[i])];
        x[i] = p >= 0 ? w[index(p)] : other[index(free_[i])];
    }
}

}  // namespace delam
