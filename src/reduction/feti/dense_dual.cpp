// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/feti/dense_dual.hpp"

#include "base/numbers.hpp"
#include "linalg/sparse/block.hpp"

namespace delam {

namespace {

// B F_s B^T over all rows, subdomain after subdomain.
DenseMatrix flexibility(const DualOperator& op, const std::vector<Subdomain>& subdomains, const Poll& poll) {
    const DualRows& rows = op.rows();
    const SparseMatrix& bt = op.b_transposed();
    DenseMatrix f(rows.count(), rows.count());
    for (std::size_t s = 0; s < subdomains.size(); ++s) {
        const std::int64_t first = rows.offset[s], last = rows.offset[s + 1];
        for (std::int64_t dj = first; dj < last; ++dj) {
            for (std::int64_t b = bt.start[index(dj)]; b < bt.start[index(dj) + 1]; ++b)
                for (std::int64_t di = first; di < last; ++di) {
                    const double value = bt.value[index(b)] * subdomains[s].flexibility(di - first, dj - first);
                    for (std::int64_t a = bt.start[index(di)]; a < bt.start[index(di) + 1]; ++a)
                        f(bt.column[index(a)], bt.column[index(b)]) += bt.value[index(a)] * value;
                }
            if (dj % 64 == 0) call_if_set(poll);
        }
    }
    return f;
}

}  // namespace

DenseDual::DenseDual(const DualOperator& op, const std::vector<Subdomain>& subdomains, const Poll& poll) : op_(op) {
    for (std::int64_t r = 0; r < op_.rows().count(); ++r)
        if (op_.active(index(r))) active_.push_back(r);
    const auto n = static_cast<std::int64_t>(active_.size()), motions = op_.coarse().size();
    {
        const DenseMatrix f = flexibility(op_, subdomains, poll);
        factor_ = DenseMatrix(n, n);
        for (std::int64_t j = 0; j < n; ++j)
            for (std::int64_t i = 0; i < n; ++i) factor_(i, j) = f(active_[index(i)], active_[index(j)]);
    }
    for (std::int64_t i = 0; i < n; ++i) factor_(i, i) += op_.compliance()[index(active_[index(i)])];
    definite_ = factor_definite(factor_, poll);
    if (!definite_) return;
    motion_ = DenseMatrix(n, motions);
    std::vector<double> alpha(index(motions), 0.0);
    for (std::int64_t k = 0; k < motions; ++k) {
        alpha[index(k)] = 1.0;
        const std::vector<double> jumps = op_.coarse().apply_transposed(alpha);
        alpha[index(k)] = 0.0;
        for (std::int64_t i = 0; i < n; ++i) motion_(i, k) = jumps[index(active_[index(i)])];
    }
    solve_lower(factor_, motion_, 0, poll);
    coarse_ = multiply_transposed(motion_, motion_);
    definite_ = factor_definite(coarse_, poll);
}

// y = L^-1 right;  alpha = (M^T M)^-1 (resultant - M^T y) with M = L^-1 G^T;  lambda = L^-T (y + M alpha)
DenseMatrix DenseDual::solve(const DenseMatrix& right, const DenseMatrix& resultant) const {
    DenseMatrix lambda(right.rows, right.columns);
    if (!definite_) return lambda;
    const auto n = static_cast<std::int64_t>(active_.size());
    DenseMatrix y(n, right.columns);
    for (std::int64_t c = 0; c < y.columns; ++c)
        for (std::int64_t i = 0; i < n; ++i) y(i, c) = right(active_[index(i)], c);
    solve_lower(factor_, y);
    const DenseMatrix carried = multiply_transposed(motion_, y);
    DenseMatrix alpha = resultant;
    for (std::size_t i = 0; i < alpha.value.size(); ++i) alpha.value[i] -= carried.value[i];
    for (std::int64_t c = 0; c < y.columns; ++c) {
        solve_lower(coarse_, column(alpha, c));
        solve_lower_transposed(coarse_, column(alpha, c));
    }
    const DenseMatrix moved = multiply(motion_, alpha);
    for (std::int64_t c = 0; c < y.columns; ++c) {
        for (std::int64_t i = 0; i < n; ++i) y(i, c) += moved(i, c);
        solve_lower_transposed(factor_, column(y, c));
        for (std::int64_t i = 0; i < n; ++i) lambda(active_[index(i)], c) = y(i, c);
    }
    return lambda;
}

}  // namespace delam
