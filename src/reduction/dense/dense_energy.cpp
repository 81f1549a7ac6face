// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/dense/dense_energy.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"

namespace delam {

namespace {

DenseMatrix block(const DenseMatrix& a, std::span<const std::int64_t> rows, std::span<const std::int64_t> columns) {
    DenseMatrix b(static_cast<std::int64_t>(rows.size()), static_cast<std::int64_t>(columns.size()));
    double* out = b.value.data();
    for (const std::int64_t c : columns) {
        const double* column = a.value.data() + c * a.rows;
        for (const std::int64_t r : rows) *out++ = column[r];
    }
    return b;
}

DenseMatrix rows_of(const DenseMatrix& a, std::span<const std::int64_t> rows) {
    DenseMatrix b(static_cast<std::int64_t>(rows.size()), a.columns);
    for (std::int64_t c = 0; c < a.columns; ++c)
        for (std::int64_t i = 0; i < b.rows; ++i) b(i, c) = a(rows[index(i)], c);
    return b;
}

}  // namespace

Condensation::Condensation(const DenseEnergy& parent, std::vector<std::int64_t> kept,
                           std::vector<std::int64_t> eliminated, std::span<const double> stiffness, const Poll& poll)
    : kept_(std::move(kept)), eliminated_(std::move(eliminated)) {
    factor_ = block(parent.stiffness, eliminated_, eliminated_);
    for (std::int64_t i = 0; i < factor_.rows; ++i) factor_(i, i) += stiffness[index(eliminated_[index(i)])];
    if (!factor_definite(factor_, poll))
        fail(DELAM_ERROR_NUMERICAL, "the condensed stiffness of ", factor_.rows, " jumps is not positive definite");
    call_if_set(poll);
    coupling_ = block(parent.stiffness, eliminated_, kept_);
    solve_lower(factor_, coupling_, 0, poll);
    load_ = rows_of(parent.load, eliminated_);
    solve_lower(factor_, load_);
    energy_.stiffness = block(parent.stiffness, kept_, kept_);
    subtract_gram(energy_.stiffness, coupling_, poll);
    mirror_lower(energy_.stiffness);
    energy_.load = rows_of(parent.load, kept_);
    subtract_product(energy_.load, coupling_, load_);
}

// x_e = L^-T (L^-1 L_e theta - V x_k)
void Condensation::recover(std::span<const double> theta, std::span<const double> kept_values,
                           std::span<double> parent) const {
    std::vector<double> x(eliminated_.size()), coupled(x.size());
    multiply(load_, theta, x);
    multiply(coupling_, kept_values, coupled);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] -= coupled[i];
    solve_lower_transposed(factor_, x);
    for (std::size_t i = 0; i < x.size(); ++i) parent[index(eliminated_[i])] = x[i];
    for (std::size_t i = 0; i < kept_.size(); ++i) parent[index(kept_[i])] = kept_values[i];
}

}  // namespace delam
