// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/zone/dense_energy.hpp"

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

std::vector<std::int64_t> sorted(std::span<const std::int64_t> rows) {
    std::vector<std::int64_t> s(rows.begin(), rows.end());
    std::sort(s.begin(), s.end());
    return s;
}

// The upper left corner of a larger matrix.
DenseMatrix enlarged(const DenseMatrix& a, std::int64_t rows, std::int64_t columns) {
    DenseMatrix b(rows, columns);
    for (std::int64_t c = 0; c < a.columns; ++c)
        std::copy(a.value.begin() + c * a.rows, a.value.begin() + (c + 1) * a.rows, b.value.begin() + c * rows);
    return b;
}

void append_columns(DenseMatrix& a, const DenseMatrix& more) {
    a.rows = more.rows;
    a.columns += more.columns;
    a.value.insert(a.value.end(), more.value.begin(), more.value.end());
}

}  // namespace

Condensation::Condensation(const DenseEnergy& parent, std::vector<std::int64_t> kept,
                           std::vector<std::int64_t> eliminated, std::span<const double> stiffness, const Poll& poll)
    : kept_(std::move(kept)), eliminated_(std::move(eliminated)) {
    factor_ = block(parent.stiffness, eliminated_, eliminated_);
    for (std::int64_t i = 0; i < factor_.rows; ++i)
        factor_(i, i) += stiffness[static_cast<std::size_t>(eliminated_[static_cast<std::size_t>(i)])];
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
    for (std::size_t k = 0; k < kept_.size(); ++k) original_.push_back(static_cast<std::int64_t>(k));
    unit_.rows = factor_.rows;
    image_.columns = static_cast<std::int64_t>(kept_.size());
    image_load_.columns = parent.load.columns;
}

double Condensation::release_cost(std::span<const std::int64_t> rows) const {
    const std::vector<std::int64_t> wanted = sorted(rows);
    std::size_t first = eliminated_.size(), held = rows.size();
    for (std::size_t e = eliminated_.size(); e-- > 0;) {
        if (!std::binary_search(wanted.begin(), wanted.end(), eliminated_[e])) continue;
        first = e;
        --held;
    }
    const auto e = static_cast<double>(eliminated_.size()), tail = e - static_cast<double>(first),
               h = static_cast<double>(held), r = static_cast<double>(rows.size()),
               k = static_cast<double>(kept_.size());
    return e * (e + k) * h + tail * (tail + k) * (r - h) + (k + r) * (k + r) * r;
}

double Condensation::cost(std::size_t eliminated, std::size_t kept) {
    const auto e = static_cast<double>(eliminated), k = static_cast<double>(kept);
    return e * e * e / 3.0 + e * e * k + e * k * k;
}

void Condensation::release(const DenseEnergy& parent, std::span<const std::int64_t> rows,
                           std::span<const double> stiffness, const Poll& poll) {
    std::vector<std::int64_t> place(static_cast<std::size_t>(parent.rows()), -1), held, places;
    for (std::size_t e = 0; e < eliminated_.size(); ++e)
        place[static_cast<std::size_t>(eliminated_[e])] = static_cast<std::int64_t>(e);
    for (const std::int64_t r : rows) {
        const std::int64_t e = place[static_cast<std::size_t>(r)];
        if (e < 0)
            held.push_back(r);
        else
            places.push_back(e);
    }
    if (!held.empty()) admit(parent, held, poll);
    if (!places.empty()) take_back(places, stiffness, poll);
}

// A held row h joins x_k: its column of V is L^-1 S_eh, and the released ones follow it too.
//   S_kh - V_k^T V_h + P_k^T P_h,    S_Rh = - C^-T P_h,    L_h - V_h^T L^-1 L_e - P_h^T p
void Condensation::admit(const DenseEnergy& parent, std::span<const std::int64_t> rows, const Poll& poll) {
    const auto old = static_cast<std::int64_t>(kept_.size()), fresh = static_cast<std::int64_t>(rows.size());
    DenseMatrix column = block(parent.stiffness, eliminated_, rows);
    solve_lower(factor_, column, 0, poll);
    DenseMatrix follow = multiply_transposed(unit_, column);
    for (double& v : follow.value) v = -v;
    solve_lower(root_, follow);

    std::vector<std::int64_t> members;
    for (const std::int64_t k : original_) members.push_back(kept_[static_cast<std::size_t>(k)]);
    for (std::int64_t j = 0; j < fresh; ++j) {
        original_.push_back(old + j);
        kept_.push_back(rows[static_cast<std::size_t>(j)]);
        members.push_back(rows[static_cast<std::size_t>(j)]);
    }
    append_columns(coupling_, column);
    append_columns(image_, follow);
    DenseMatrix among = block(parent.stiffness, members, rows);
    subtract_product(among, coupling_, column);
    const DenseMatrix through = multiply_transposed(image_, follow),
                      on_released = multiply_transposed(inverse_, follow);
    call_if_set(poll);
    DenseMatrix load = rows_of(parent.load, rows);
    subtract_product(load, column, load_);
    subtract_product(load, follow, image_load_);

    energy_.stiffness = enlarged(energy_.stiffness, old + fresh, old + fresh);
    energy_.load = enlarged(energy_.load, old + fresh, energy_.load.columns);
    for (std::int64_t j = 0; j < fresh; ++j) {
        for (std::int64_t i = 0; i < among.rows; ++i) {
            const std::int64_t k = original_[static_cast<std::size_t>(i)];
            energy_.stiffness(k, old + j) = energy_.stiffness(old + j, k) = among(i, j) + through(i, j);
        }
        for (std::int64_t i = 0; i < on_released.rows; ++i) {
            const std::int64_t r = released_[static_cast<std::size_t>(i)];
            energy_.stiffness(r, old + j) = energy_.stiffness(old + j, r) = -on_released(i, j);
        }
        for (std::int64_t q = 0; q < load.columns; ++q) energy_.load(old + j, q) = load(j, q);
    }
}

// With the new rows of C^-1 (x_R - W x_k - w theta) = N x_R - P x_k - p theta the energy grows by half their square:
//   S += Q^T Q,   L += Q^T p,   Q = [- P | N],   less the springs that S_ee + s_e had.
void Condensation::take_back(std::span<const std::int64_t> places, std::span<const double> stiffness,
                             const Poll& poll) {
    const auto old = static_cast<std::int64_t>(kept_.size()), fresh = static_cast<std::int64_t>(places.size());
    const std::int64_t before = unit_.columns;
    DenseMatrix unit(factor_.rows, fresh);
    const std::int64_t first = *std::min_element(places.begin(), places.end());
    for (std::int64_t j = 0; j < fresh; ++j) {
        unit(places[static_cast<std::size_t>(j)], j) = 1.0;
        released_.push_back(old + j);
        kept_.push_back(eliminated_[static_cast<std::size_t>(places[static_cast<std::size_t>(j)])]);
    }
    solve_lower(factor_, unit, first, poll);
    // [C 0; X^T C'] with X = C^-1 Z^T Z', C' C'^T = Z'^T Z' - X^T X
    DenseMatrix cross = multiply_transposed(unit_, unit, first);
    solve_lower(root_, cross);
    DenseMatrix corner = multiply_transposed(unit, unit, first);
    subtract_gram(corner, cross);
    call_if_set(poll);
    if (!factor_definite(corner, poll))
        fail(DELAM_ERROR_NUMERICAL, "the flexibility of ", fresh, " released jumps is not positive definite");
    DenseMatrix image = multiply_transposed(unit, coupling_, first),
                image_load = multiply_transposed(unit, load_, first), own(fresh, fresh);
    for (double& v : image.value) v = -v;
    subtract_product(image, cross, image_);
    call_if_set(poll);
    solve_lower(corner, image, 0, poll);
    subtract_product(image_load, cross, image_load_);
    solve_lower(corner, image_load);
    for (std::int64_t i = 0; i < fresh; ++i) own(i, i) = 1.0;
    solve_lower(corner, own);
    DenseMatrix on_old(fresh, before);
    subtract_product(on_old, cross, inverse_);
    solve_lower(corner, on_old);

    DenseMatrix rows(fresh, old + fresh);
    for (std::int64_t i = 0; i < fresh; ++i) {
        for (std::int64_t k = 0; k < image.columns; ++k) rows(i, original_[static_cast<std::size_t>(k)]) = -image(i, k);
        for (std::int64_t k = 0; k < before; ++k) rows(i, released_[static_cast<std::size_t>(k)]) = on_old(i, k);
        for (std::int64_t k = 0; k < fresh; ++k) rows(i, old + k) = own(i, k);
    }
    energy_.stiffness = enlarged(energy_.stiffness, old + fresh, old + fresh);
    energy_.load = enlarged(energy_.load, old + fresh, energy_.load.columns);
    add_gram(energy_.stiffness, rows, poll);
    mirror_lower(energy_.stiffness);
    for (std::int64_t j = 0; j < fresh; ++j)
        energy_.stiffness(old + j, old + j) -=
            stiffness[static_cast<std::size_t>(kept_[static_cast<std::size_t>(old + j)])];
    const DenseMatrix load = multiply_transposed(rows, image_load);
    for (std::size_t i = 0; i < load.value.size(); ++i) energy_.load.value[i] += load.value[i];

    root_ = enlarged(root_, before + fresh, before + fresh);
    inverse_ = enlarged(inverse_, before + fresh, before + fresh);
    image_ = enlarged(image_, before + fresh, image.columns);
    image_load_ = enlarged(image_load_, before + fresh, image_load.columns);
    for (std::int64_t i = 0; i < fresh; ++i) {
        for (std::int64_t k = 0; k < before; ++k) {
            root_(before + i, k) = cross(k, i);
            inverse_(before + i, k) = on_old(i, k);
        }
        for (std::int64_t k = 0; k <= i; ++k) {
            root_(before + i, before + k) = corner(i, k);
            inverse_(before + i, before + k) = own(i, k);
        }
        for (std::int64_t k = 0; k < image.columns; ++k) image_(before + i, k) = image(i, k);
        for (std::int64_t k = 0; k < image_load.columns; ++k) image_load_(before + i, k) = image_load(i, k);
    }
    append_columns(unit_, unit);
}

// x_e = L^-T (L^-1 L_e theta - V x_k + Z mu),   mu = D^-1 (x_R - x_R*)
void Condensation::recover(std::span<const double> theta, std::span<const double> kept_values,
                           std::span<double> parent) const {
    std::vector<double> x(eliminated_.size()), coupled(x.size()), base(original_.size()), mu(released_.size());
    for (std::size_t i = 0; i < base.size(); ++i) base[i] = kept_values[static_cast<std::size_t>(original_[i])];
    for (std::size_t i = 0; i < mu.size(); ++i) mu[i] = kept_values[static_cast<std::size_t>(released_[i])];
    multiply(load_, theta, x);
    multiply(coupling_, base, coupled);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] -= coupled[i];
    if (!mu.empty()) {
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
