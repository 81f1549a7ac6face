// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/condensed/reduced_energy.hpp"

#include <numeric>

#include "base/numbers.hpp"

namespace delam {

namespace {

DenseMatrix pick(const DenseMatrix& a, std::span<const std::int64_t> rows, std::span<const std::int64_t> columns) {
    DenseMatrix b(static_cast<std::int64_t>(rows.size()), static_cast<std::int64_t>(columns.size()));
    for (std::int64_t j = 0; j < b.columns; ++j)
        for (std::int64_t i = 0; i < b.rows; ++i) b(i, j) = a(rows[index(i)], columns[index(j)]);
    return b;
}

}  // namespace

ReducedEnergy::ReducedEnergy(const TrailingEquations& equations, const Superelements& skeleton,
                             const Elimination& elimination)
    : equations_(&equations), elimination_(&elimination) {
    std::vector<std::int64_t> at(index(equations.rest_count()), -1);
    for (std::int64_t i = 0; i < elimination.energy().rows(); ++i) {
        const std::int64_t role = equations.role(skeleton.variable()[index(elimination.places()[index(i)])]);
        if (role >= 0) {
            at[index(role)] = static_cast<std::int64_t>(rest_.size());
            rest_.push_back(i);
            rest_number_.push_back(role);
        } else {
            pivot_.push_back(i);
            pivot_number_.push_back(-2 - role);
        }
    }
    if (pivot_.empty()) return;
    binding_ = DenseMatrix(static_cast<std::int64_t>(pivot_.size()), static_cast<std::int64_t>(rest_.size()));
    for (std::int64_t i = 0; i < binding_.rows; ++i)
        for (const auto& [j, m] : equations.row(pivot_number_[index(i)])) binding_(i, at[index(j)]) = m;
    reduce();
}

void ReducedEnergy::reduce() {
    const DenseEnergy& energy = elimination_->energy();
    std::vector<std::int64_t> all(index(energy.load.columns));
    std::iota(all.begin(), all.end(), 0);
    const DenseMatrix s_pp = pick(energy.stiffness, pivot_, pivot_), s_pr = pick(energy.stiffness, pivot_, rest_);
    energy_ = {pick(energy.stiffness, rest_, rest_), pick(energy.load, rest_, all)};
    DenseMatrix half = multiply(s_pp, binding_);
    for (std::size_t i = 0; i < half.value.size(); ++i) half.value[i] = 0.5 * half.value[i] + s_pr.value[i];
    const DenseMatrix product = multiply_transposed(binding_, half);
    const std::int64_t rest = energy_.rows();
    for (std::int64_t j = 0; j < rest; ++j)
        for (std::int64_t i = 0; i < rest; ++i) energy_.stiffness(i, j) += product(i, j) + product(j, i);
    if (all.empty()) return;
    const DenseMatrix l_p = pick(energy.load, pivot_, all), d = pick(equations_->prescribed(), pivot_number_, all);
    DenseMatrix right = multiply(s_pp, d);
    for (std::size_t i = 0; i < right.value.size(); ++i) right.value[i] = l_p.value[i] - right.value[i];
    const DenseMatrix through = multiply_transposed(binding_, right), direct = multiply_transposed(s_pr, d);
    for (std::size_t i = 0; i < energy_.load.value.size(); ++i)
        energy_.load.value[i] += through.value[i] - direct.value[i];
}

std::vector<double> ReducedEnergy::recover(std::span<const double> theta, std::span<const double> rest) const {
    std::vector<double> all(rest_.size() + pivot_.size());
    for (std::size_t i = 0; i < rest.size(); ++i) all[index(rest_[i])] = rest[i];
    if (pivot_.empty()) return all;
    std::vector<double> bound(pivot_.size());
    multiply(binding_, rest, bound);
    for (std::size_t i = 0; i < bound.size(); ++i) {
        for (std::size_t p = 0; p < theta.size(); ++p)
            bound[i] += equations_->prescribed()(pivot_number_[i], static_cast<std::int64_t>(p)) * theta[p];
        all[index(pivot_[i])] = bound[i];
    }
    return all;
}

}  // namespace delam
