// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/condensed/dense_energy.hpp"

#include <algorithm>

#include "base/error.hpp"
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
        for (std::int64_t i = 0; i < b.rows; ++i) b(i, c) = a(rows[static_cast<std::size_t>(i)], c);
    return b;
}

}  // namespace

Condensation::Condensation(const DenseEnergy& parent, std::vector<std::int64_t> kept, std::vector<std::int64_t> eliminated,
                           std::span<const double> stiffness)
    : kept_(std::move(kept)), eliminated_(std::move(eliminated)) {
    factor_ = block(parent.stiffness, eliminated_, eliminated_);
    for (std::int64_t i = 0; i < factor_.rows; ++i)
        factor_(i, i) += stiffness[static_cast<std::size_t>(eliminated_[static_cast<std::size_t>(i)])];
    if (!factor_definite(factor_))
        fail(DELAM_ERROR_NUMERICAL, "the condensed stiffness of ", factor_.rows, " jumps is not positive definite");
    coupling_ = block(parent.stiffness, eliminated_, kept_);
    solve_lower(factor_, coupling_);
    load_ = rows_of(parent.load, eliminated_);
    solve_lower(factor_, load_);
    base_.stiffness = block(parent.stiffness, kept_, kept_);
    subtract_gram(base_.stiffness, coupling_);
    mirror_lower(base_.stiffness);
    base_.load = rows_of(parent.load, kept_);
    subtract_product(base_.load, coupling_, load_);
}

double Condensation::release_cost(std::int64_t rows) const {
    const auto e = static_cast<double>(factor_.rows), k = static_cast<double>(kept_.size()), r = static_cast<double>(rows);
    const double all = r + static_cast<double>(released_.size());
    return e * e * r + e * k * r + e * all * r + (k + r) * (k + r) * all;
}

double Condensation::cost() const {
    const auto e = static_cast<double>(factor_.rows), k = static_cast<double>(kept_.size());
    return e * e * e / 3.0 + e * e * k + e * k * k;
}

void Condensation::release(const DenseEnergy& parent, std::span<const std::int64_t> rows, std::span<const double> stiffness) {
    std::vector<std::int64_t> place(static_cast<std::size_t>(parent.rows()), -1), admitted, fresh;
    for (std::size_t e = 0; e < eliminated_.size(); ++e) place[static_cast<std::size_t>(eliminated_[e])] = static_cast<std::int64_t>(e);
    for (const std::int64_t r : rows) (place[static_cast<std::size_t>(r)] < 0 ? admitted : fresh).push_back(r);
    kept_.resize(kept_.size() - released_.size());

    if (!admitted.empty()) {
        DenseMatrix column = block(parent.stiffness, eliminated_, admitted);
        solve_lower(factor_, column);
        const std::int64_t old = static_cast<std::int64_t>(kept_.size());
        kept_.insert(kept_.end(), admitted.begin(), admitted.end());
        DenseMatrix cross = block(parent.stiffness, kept_, admitted);
        coupling_.value.insert(coupling_.value.end(), column.value.begin(), column.value.end());
        coupling_.columns += column.columns;
        subtract_product(cross, coupling_, column);
        DenseEnergy wider{DenseMatrix(coupling_.columns, coupling_.columns), rows_of(parent.load, kept_)};
        for (std::int64_t j = 0; j < old; ++j)
            std::copy_n(base_.stiffness.value.begin() + j * old, old, wider.stiffness.value.begin() + j * wider.rows());
        for (std::int64_t j = 0; j < cross.columns; ++j)
            for (std::int64_t i = 0; i < cross.rows; ++i)
                wider.stiffness(i, old + j) = wider.stiffness(old + j, i) = cross(i, j);
        subtract_product(wider.load, coupling_, load_);
        base_ = std::move(wider);
    }
    if (!fresh.empty()) {
        DenseMatrix unit(factor_.rows, static_cast<std::int64_t>(fresh.size()));
        for (std::size_t j = 0; j < fresh.size(); ++j) {
            const std::int64_t e = place[static_cast<std::size_t>(fresh[j])];
            unit(e, static_cast<std::int64_t>(j)) = 1.0;
            released_.push_back(e);
        }
        solve_lower(factor_, unit);
        unit_.rows = unit.rows;
        unit_.value.insert(unit_.value.end(), unit.value.begin(), unit.value.end());
        unit_.columns += unit.columns;
    }
    for (const std::int64_t e : released_) kept_.push_back(eliminated_[static_cast<std::size_t>(e)]);
    if (!released_.empty()) update(stiffness);
}

//   S_kk + P^T P     - P^T C^-1            L_k - P^T p
//                    C^-T C^-1 - s_R       C^-T p          with  P = C^-1 W = - C^-1 Z^T V,  p = C^-1 w = C^-1 Z^T L^-1 L_e
void Condensation::update(std::span<const double> stiffness) {
    const auto r = static_cast<std::int64_t>(released_.size()), k = base_.rows();
    root_ = multiply_transposed(unit_, unit_);
    if (!factor_definite(root_)) fail(DELAM_ERROR_NUMERICAL, "the flexibility of ", r, " released jumps is not positive definite");
    image_ = multiply_transposed(unit_, coupling_);
    for (double& v : image_.value) v = -v;
    solve_lower(root_, image_);
    image_load_ = multiply_transposed(unit_, load_);
    solve_lower(root_, image_load_);
    DenseMatrix inverse(r, r);
    for (std::int64_t i = 0; i < r; ++i) inverse(i, i) = 1.0;
    solve_lower(root_, inverse);

    energy_.stiffness = DenseMatrix(k + r, k + r);
    energy_.load = DenseMatrix(k + r, base_.load.columns);
    const DenseMatrix update = multiply_transposed(image_, image_), cross = multiply_transposed(image_, inverse),
                      corner = multiply_transposed(inverse, inverse), on_kept = multiply_transposed(image_, image_load_),
                      on_released = multiply_transposed(inverse, image_load_);
    for (std::int64_t j = 0; j < k; ++j)
        for (std::int64_t i = 0; i < k; ++i) energy_.stiffness(i, j) = base_.stiffness(i, j) + update(i, j);
    for (std::int64_t j = 0; j < r; ++j) {
        for (std::int64_t i = 0; i < k; ++i) energy_.stiffness(i, k + j) = energy_.stiffness(k + j, i) = -cross(i, j);
        for (std::int64_t i = 0; i < r; ++i) energy_.stiffness(k + i, k + j) = corner(i, j);
        const std::int64_t parent = eliminated_[static_cast<std::size_t>(released_[static_cast<std::size_t>(j)])];
        energy_.stiffness(k + j, k + j) -= stiffness[static_cast<std::size_t>(parent)];
    }
    for (std::int64_t p = 0; p < base_.load.columns; ++p) {
        for (std::int64_t i = 0; i < k; ++i) energy_.load(i, p) = base_.load(i, p) - on_kept(i, p);
        for (std::int64_t i = 0; i < r; ++i) energy_.load(k + i, p) = on_released(i, p);
    }
}

// x_e = L^-T (L^-1 L_e theta - V x_k + Z mu),   mu = D^-1 (x_R - x_R*)
void Condensation::recover(std::span<const double> theta, std::span<const double> kept_values, std::span<double> parent) const {
    std::vector<double> x(eliminated_.size()), coupled(x.size());
    const std::span<const double> base = kept_values.first(kept_.size() - released_.size());
    multiply(load_, theta, x);
    multiply(coupling_, base, coupled);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] -= coupled[i];
    if (!released_.empty()) {
        std::vector<double> mu(kept_values.begin() + static_cast<std::ptrdiff_t>(base.size()), kept_values.end());
        std::vector<double> follow(mu.size()), loaded(mu.size());
        solve_lower(root_, mu);
        multiply(image_, base, follow);
        multiply(image_load_, theta, loaded);
        for (std::size_t i = 0; i < mu.size(); ++i) mu[i] -= follow[i] + loaded[i];
        solve_lower_transposed(root_, mu);
        multiply(unit_, mu, coupled);
        for (std::size_t i = 0; i < x.size(); ++i) x[i] += coupled[i];
    }
    solve_lower_transposed(factor_, x);
    for (std::size_t i = 0; i < x.size(); ++i) parent[static_cast<std::size_t>(eliminated_[i])] = x[i];
    for (std::size_t i = 0; i < kept_.size(); ++i) parent[static_cast<std::size_t>(kept_[i])] = kept_values[i];
}

}  // namespace delam
