// SPDX-License-Identifier: BSD-3-Clause
//
// The rank is found by an up-looking Cholesky factorisation (T. Davis, Direct Methods for Sparse Linear Systems, 2006,
// chapter 4) of the Gram matrix, scaled to a unit diagonal, that leaves out each row whose pivot vanishes. Pivots of a
// Gram matrix are squares of sines and lose all digits below about 1e-10 to cancellation where many rows lie between.
// A small pivot is therefore computed again, as the square of what is left of the row of G itself, which has no
// cancellation.
#include "linalg/sparse/semidefinite.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"

namespace delam {

namespace {

// Pivots below it are computed again. (Measured by verify/bench/constants.py on 250 random scenes: half and twice
// decide alike.)
constexpr double doubtful = 1e-4;

// Rows before row k of a symmetric matrix in which L has entries in row k, sorted topologically.
class Reach {
public:
    explicit Reach(const SparseMatrix& a)
        : a_(a),
          parent_(index(a.rows), -1),
          first_(index(a.rows)),
          mark_(index(a.rows), -1),
          stack_(index(a.rows)),
          path_(index(a.rows)) {
        std::vector<std::int64_t> ancestor(index(a.rows), -1);
        for (std::int64_t k = 0; k < a.rows; ++k)
            for (std::int64_t e = a.start[index(k)]; e < a.start[index(k) + 1]; ++e)
                for (std::int64_t i = a.column[index(e)]; i >= 0 && i < k;) {
                    const std::int64_t next = std::exchange(ancestor[index(i)], k);
                    if (next < 0) parent_[index(i)] = k;
                    i = next;
                }
        for (std::size_t i = 0; i < first_.size(); ++i) first_[i] = static_cast<std::int64_t>(i);
        for (std::size_t i = 0; i < first_.size(); ++i)
            if (parent_[i] >= 0) first_[index(parent_[i])] = std::min(first_[index(parent_[i])], first_[i]);
    }
    // No row below this one depends on an earlier one, directly or through others.
    std::int64_t first_below(std::int64_t k) const { return first_[index(k)]; }
    std::span<const std::int64_t> of(std::int64_t k) {
        std::size_t top = stack_.size();
        mark_[index(k)] = k;
        for (std::int64_t e = a_.start[index(k)]; e < a_.start[index(k) + 1]; ++e) {
            std::size_t length = 0;
            for (std::int64_t i = a_.column[index(e)]; i < k && mark_[index(i)] != k; i = parent_[index(i)]) {
                path_[length++] = i;
                mark_[index(i)] = k;
            }
            while (length > 0) stack_[--top] = path_[--length];
        }
        return std::span(stack_).subspan(top);
    }

    void restart() { std::fill(mark_.begin(), mark_.end(), -1); }

private:
    const SparseMatrix& a_;
    std::vector<std::int64_t> parent_, first_, mark_, stack_, path_;
};

// L of a Gram matrix with unit diagonal, column by column without its diagonal, and G itself. All rows are in the order
// of elimination.
class RankFactor {
public:
    RankFactor(const SparseMatrix& gram, const SparseMatrix& g, std::span<const double> carries)
        : gram_(gram),
          g_(g),
          carries_(carries),
          reach_(gram),
          x_(index(gram.rows), 0.0),
          y_(index(gram.rows), 0.0),
          diagonal_(index(gram.rows), 0.0),
          start_(index(gram.rows) + 1, 0),
          left_(index(g.columns), 0.0) {
        for (std::int64_t k = 0; k < gram.rows; ++k) {
            const std::span<const std::int64_t> reached = reach_.of(k);
            poll_cancel("rank", static_cast<std::int64_t>(reached.size()) / 64 + 1);
            for (const std::int64_t i : reached) ++start_[index(i) + 1];
        }
        reach_.restart();
        for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
        row_.resize(index(start_.back()));
        value_.resize(row_.size());
        end_.assign(start_.begin(), start_.end() - 1);
    }

    // True if row k is independent of those before it. To be called for each row in turn.
    bool add(std::int64_t k, double tolerance) {
        double pivot = 0.0;  // stays 0 if no column of the row carries
        for (std::int64_t e = gram_.start[index(k)]; e < gram_.start[index(k) + 1]; ++e) {
            const std::int64_t i = gram_.column[index(e)];
            if (i < k) x_[index(i)] = gram_.value[index(e)];
            if (i == k) pivot = gram_.value[index(e)];
        }
        const std::span<const std::int64_t> reached = reach_.of(k);
        std::int64_t work = 0;
        for (const std::int64_t i : reached) {
            double& x = x_[index(i)];
            x = diagonal_[index(i)] > 0.0 ? x / diagonal_[index(i)] : 0.0;
            for (std::int64_t p = start_[index(i)]; p < end_[index(i)]; ++p)
                x_[index(row_[index(p)])] -= value_[index(p)] * x;
            work += end_[index(i)] - start_[index(i)];
            pivot -= x * x;
        }
        poll_cancel("rank", work / 256 + 1);
        if (pivot < doubtful && !reached.empty()) pivot = exact_pivot(k);
        if (pivot > tolerance) diagonal_[index(k)] = std::sqrt(pivot);
        for (const std::int64_t i : reached) {
            const double x = std::exchange(x_[index(i)], 0.0);
            if (!(pivot > tolerance) || x == 0.0) continue;
            row_[index(end_[index(i)])] = k;
            value_[index(end_[index(i)]++)] = x;
        }
        return pivot > tolerance;
    }

private:
    // The square of what is left of row k of G without its projection g = sum_i y_i g_i on those before it, L^T y = x.
    double exact_pivot(std::int64_t k) {
        const std::int64_t first = reach_.first_below(k);
        std::vector<std::int64_t> touched;
        const auto subtract = [&](std::int64_t row, double share) {
            for (std::int64_t e = g_.start[index(row)]; e < g_.start[index(row) + 1]; ++e) {
                touched.push_back(g_.column[index(e)]);
                left_[index(touched.back())] -= share * g_.value[index(e)];
            }
        };
        subtract(k, -1.0);
        for (std::int64_t i = k - 1; i >= first; --i) {
            if (!(diagonal_[index(i)] > 0.0)) continue;
            double sum = x_[index(i)];
            for (std::int64_t p = start_[index(i)]; p < end_[index(i)]; ++p)
                sum -= value_[index(p)] * y_[index(row_[index(p)])];
            y_[index(i)] = sum / diagonal_[index(i)];
            if (sum != 0.0) subtract(i, y_[index(i)]);
        }
        std::fill(y_.begin() + first, y_.begin() + k, 0.0);
        double square = 0.0;
        for (const std::int64_t r : touched) {
            const double rest = std::exchange(left_[index(r)], 0.0);
            square += carries_[index(r)] * rest * rest;
        }
        return square;
    }

    const SparseMatrix& gram_;
    const SparseMatrix& g_;
    std::span<const double> carries_;
    Reach reach_;
    std::vector<double> x_, y_, diagonal_;
    std::vector<std::int64_t> start_, end_, row_;
    std::vector<double> value_, left_;
};

// The rows of a matrix in another order, each multiplied by a number.
SparseMatrix rows_in_order(const SparseMatrix& g, std::span<const std::int64_t> order, std::span<const double> scale) {
    SparseMatrix out;
    out.rows = g.rows;
    out.columns = g.columns;
    for (const std::int64_t r : order) {
        for (std::int64_t e = g.start[index(r)]; e < g.start[index(r) + 1]; ++e) {
            out.column.push_back(g.column[index(e)]);
            out.value.push_back(scale[index(r)] * g.value[index(e)]);
        }
        out.start.push_back(static_cast<std::int64_t>(out.column.size()));
    }
    return out;
}

// 1 / sqrt of the diagonal, 1 where it vanishes.
std::vector<double> unit_scale(const SparseMatrix& a) {
    std::vector<double> scale(index(a.rows), 1.0);
    for (std::int64_t r = 0; r < a.rows; ++r)
        for (std::int64_t e = a.start[index(r)]; e < a.start[index(r) + 1]; ++e)
            if (a.column[index(e)] == r && a.value[index(e)] > 0.0)
                scale[index(r)] = 1.0 / std::sqrt(a.value[index(e)]);
    return scale;
}

}  // namespace

SparseMatrix weighted_gram(const SparseMatrix& g, const SparseMatrix& gt, std::span<const double> weight) {
    SparseMatrix gram;
    gram.rows = gram.columns = g.rows;
    std::vector<double> sum(index(g.rows), 0.0);
    std::vector<std::int64_t> seen(index(g.rows), -1), row;
    for (std::int64_t i = 0; i < g.rows; ++i) {
        row.assign(1, i);  // the diagonal, even of an empty row
        seen[index(i)] = i;
        for (std::int64_t e = g.start[index(i)]; e < g.start[index(i) + 1]; ++e) {
            const std::int64_t r = g.column[index(e)];
            const double w = weight[index(r)] * g.value[index(e)];
            poll_cancel("coarse problem", (gt.start[index(r) + 1] - gt.start[index(r)]) / 64 + 1);
            for (std::int64_t f = gt.start[index(r)]; f < gt.start[index(r) + 1]; ++f) {
                const std::int64_t j = gt.column[index(f)];
                if (std::exchange(seen[index(j)], i) != i) row.push_back(j);
                sum[index(j)] += w * gt.value[index(f)];
            }
        }
        std::sort(row.begin(), row.end());
        for (const std::int64_t j : row) {
            gram.column.push_back(j);
            gram.value.push_back(std::exchange(sum[index(j)], 0.0));
        }
        gram.start.push_back(static_cast<std::int64_t>(gram.column.size()));
    }
    return gram;
}

std::vector<std::int64_t> independent_rows(const SparseMatrix& g, const SparseMatrix& gt,
                                           std::span<const double> carries, double tolerance) {
    if (g.rows == 0) return {};
    const SparseMatrix gram = weighted_gram(g, gt, carries);
    const std::vector<std::int64_t> order = SparseCholesky(gram).order();
    const SparseMatrix own = rows_in_order(g, order, unit_scale(gram));
    const SparseMatrix scaled = weighted_gram(own, transpose(own), carries);
    RankFactor factor(scaled, own, carries);
    std::vector<std::int64_t> rows;
    for (std::int64_t k = 0; k < g.rows; ++k)
        if (factor.add(k, tolerance)) rows.push_back(order[index(k)]);
    std::sort(rows.begin(), rows.end());
    return rows;
}

SemidefiniteFactor::SemidefiniteFactor(const SparseMatrix& pattern, std::span<const std::int64_t> rows)
    : scale_(rows.size(), 1.0), rows_(rows.begin(), rows.end()) {
    std::vector<std::int64_t> place(index(pattern.rows), -1);
    for (std::size_t i = 0; i < rows_.size(); ++i) place[index(rows_[i])] = static_cast<std::int64_t>(i);
    block_.rows = block_.columns = static_cast<std::int64_t>(rows_.size());
    for (const std::int64_t r : rows_) {
        for (std::int64_t e = pattern.start[index(r)]; e < pattern.start[index(r) + 1]; ++e) {
            if (place[index(pattern.column[index(e)])] < 0) continue;
            source_.push_back(e);
            block_.column.push_back(place[index(pattern.column[index(e)])]);
        }
        block_.start.push_back(static_cast<std::int64_t>(block_.column.size()));
    }
    block_.value.assign(block_.column.size(), 0.0);
    factor_ = std::make_unique<SparseCholesky>(block_);
}

void SemidefiniteFactor::factorise(const SparseMatrix& a) {
    if (rows_.empty()) return;
    for (std::size_t e = 0; e < source_.size(); ++e) block_.value[e] = a.value[index(source_[e])];
    scale_ = unit_scale(block_);
    for (std::int64_t r = 0; r < block_.rows; ++r)
        for (std::int64_t e = block_.start[index(r)]; e < block_.start[index(r) + 1]; ++e)
            block_.value[index(e)] *= scale_[index(r)] * scale_[index(block_.column[index(e)])];
    if (!factor_->factorise(block_))
        fail(DELAM_ERROR_NUMERICAL, "the coarse problem is not positive definite at row ",
             factor_->smallest_pivot().variable, " of ", block_.rows);
}

void SemidefiniteFactor::solve(std::span<double> x) const {
    std::vector<double> b(rows_.size()), y(rows_.size());
    for (std::size_t i = 0; i < b.size(); ++i) b[i] = scale_[i] * x[index(rows_[i])];
    if (!b.empty()) factor_->solve(b, y);
    std::fill(x.begin(), x.end(), 0.0);
    for (std::size_t i = 0; i < y.size(); ++i) x[index(rows_[i])] = scale_[i] * y[i];
}

}  // namespace delam
