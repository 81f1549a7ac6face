// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/sparse/floating.hpp"

#include <algorithm>
#include <cmath>

#include "base/numbers.hpp"
#include "linalg/dense/dense.hpp"
#include "reduction/sparse/spring_entries.hpp"

namespace delam {

namespace {

// Springs that resist a motion by less than the first part of the bodies' stiffness hold it weakly; a spring that
// replaces a support has the second. (Measured by verify/bench/constants.py on 250 random scenes: half and twice decide
// alike; of the second they change digits of half of the iterated analyses, within their tolerance.)
constexpr double weakly = 1e-7;
constexpr double anchored = 1e-2;
constexpr double rounded_load = 1e-11;  // as in dense_zone.cpp, where half and twice decide alike

// Returns the eigenvalues and eigenvectors of Z^T W Z with a diagonal W; the product is formed block by block of rows.
Eigen weighted_gram(const DenseMatrix& z, std::span<const double> weight) {
    constexpr std::int64_t most = 4096;
    DenseMatrix gram(z.columns, z.columns);
    for (std::int64_t first = 0; first < z.rows; first += most) {
        DenseMatrix plain(std::min(most, z.rows - first), z.columns), scaled = plain;
        for (std::int64_t c = 0; c < z.columns; ++c)
            for (std::int64_t r = 0; r < plain.rows; ++r) {
                plain(r, c) = z(first + r, c);
                scaled(r, c) = plain(r, c) * weight[index(first + r)];
            }
        const DenseMatrix part = multiply_transposed(plain, scaled);
        add_scaled(1.0, part.value, gram.value);
    }
    return eigen_symmetric(std::move(gram));
}

}  // namespace

Floating::Floating(const BodySystem& bodies, const JumpSystem& system)
    : bodies_(bodies), system_(system), rigid_(bodies.problem()) {
    const JumpVariables& variables = bodies.variables();
    dof_of_.assign(index(variables.leading + variables.kept), -1);
    const SparseMatrix& t = variables.transform;
    for (std::int64_t dof = 0; dof < t.rows; ++dof) {
        const std::int64_t e = t.start[index(dof)];
        if (t.start[index(dof) + 1] != e + 1 || t.value[index(e)] != 1.0) continue;
        if (t.column[index(e)] < static_cast<std::int64_t>(dof_of_.size())) dof_of_[index(t.column[index(e)])] = dof;
    }
}

std::vector<double> Floating::in_variables(std::span<const double> combination) const {
    if (std::all_of(combination.begin(), combination.end(), [](double c) { return c == 0.0; }))
        return std::vector<double>(index(system_.count()), 0.0);
    const std::vector<double> u = rigid_.displacement(combination);
    std::vector<double> v(index(system_.count()), 0.0), jump(system_.rows().size());
    const std::size_t first = index(system_.first());
    for (std::size_t i = first; i < dof_of_.size(); ++i) v[i - first] = u[index(dof_of_[i])];
    multiply(rigid_.jumps(), combination, jump);
    const JumpVariables& variables = bodies_.variables();
    for (std::size_t r = 0; r < jump.size(); ++r)
        if (const SparseVector& row = variables.row[r]; row.size() == 1 && row.front().second == 1.0)
            v[dof_of_.size() + index(row.front().first) - first] = jump[r];
    return v;
}

void Floating::update() {
    const DenseMatrix& z = rigid_.jumps();
    if (z.columns == 0) return;
    const std::size_t rows = system_.rows().size();
    std::vector<double> spring(rows, 0.0);
    for (const Zone::Coupling& c : system_.couplings())
        if (c.row == c.column) spring[index(c.row)] = c.value;
    std::vector<std::uint8_t> active(rows, 0);
    for (const Zone::Coupling& c : system_.couplings())
        if (c.value != 0.0) active[index(c.row)] = 1;
    if (known_ && held_ == system_.held() && active_ == active && spring_ == spring) return;
    known_ = false;  // until this has come to its end
    free_.clear();
    weak_.clear();
    anchors_.clear();
    free_anchors_.clear();
    combination_.clear();
    held_ = system_.held();
    active_ = std::move(active);
    spring_ = std::move(spring);
    if (!all_resisted()) examine();
    known_ = true;
}

// Z^T C Z, where held rows and stiffer springs are as stiff as the bodies, has no small eigenvalue. Springs that become
// softer take at most their share of its trace (Weyl): a state is compared with the last one whose eigenvalues are
// known, row by row.
bool Floating::all_resisted() {
    const DenseMatrix& z = rigid_.jumps();
    const std::size_t rows = spring_.size();
    std::vector<double> body(rows), now(rows);
    for (std::size_t r = 0; r < rows; ++r) {
        body[r] = row_diagonal(system_, r);
        now[r] = held_[r] != 0 ? body[r] : std::min(body[r], spring_[r]);
    }
    if (reach_.empty()) {
        enough_ = 1.001 * weakly * weighted_gram(z, body).value.back();
        reach_.assign(rows, 0.0);
        for (std::int64_t c = 0; c < z.columns; ++c)
            for (std::size_t r = 0; r < rows; ++r) {
                const double length = z(static_cast<std::int64_t>(r), c);
                reach_[r] += length * length;
            }
    }
    if (!firm_.empty()) {
        double softened = 0.0;
        for (std::size_t r = 0; r < rows; ++r) softened += std::max(0.0, firm_[r] - now[r]) * reach_[r];
        if (resisted_ - softened >= enough_) return true;
    }
    ++examinations_;
    const std::vector<double> eigen = weighted_gram(z, now).value;
    const double rounding = rounded_load * std::max(-eigen.front(), eigen.back());
    firm_.clear();
    if (eigen.front() - rounding < enough_) return false;
    resisted_ = eigen.front() - rounding;
    firm_ = std::move(now);
    return true;
}

void Floating::examine() {
    const DenseMatrix& z = rigid_.jumps();
    const std::size_t rows = spring_.size();
    const DenseMatrix loose = split_motions(z, held_).free;  // held rows do not resist them
    if (loose.columns == 0) return;
    const DenseMatrix jumps = multiply(z, loose);
    const Combinations parts = split_motions(jumps, active_);
    const DenseMatrix resisted = multiply(jumps, parts.held);
    DenseMatrix stiff(resisted.columns, resisted.columns), bodies(resisted.columns, resisted.columns);
    for (std::size_t r = 0; r < rows; ++r) {
        const double d = row_diagonal(system_, r);
        const auto at = static_cast<std::int64_t>(r);
        for (std::int64_t i = 0; i < resisted.columns; ++i)
            for (std::int64_t j = 0; j < resisted.columns; ++j) {
                stiff(i, j) += resisted(at, i) * resisted(at, j) * spring_[r];
                bodies(i, j) += resisted(at, i) * resisted(at, j) * d;
            }
    }
    double scale = 0.0;
    for (std::int64_t i = 0; i < bodies.rows; ++i) scale = std::max(scale, bodies(i, i));
    const Eigen eigen = eigen_symmetric(std::move(stiff));
    std::int64_t soft = 0;
    while (soft < resisted.columns && eigen.value[index(soft)] < weakly * scale) ++soft;
    DenseMatrix floating(loose.columns, parts.free.columns + soft);
    std::copy(parts.free.value.begin(), parts.free.value.end(), floating.value.begin());
    for (std::int64_t c = 0; c < soft; ++c)
        for (std::int64_t k = 0; k < resisted.columns; ++k)
            for (std::int64_t i = 0; i < loose.columns; ++i)
                floating(i, parts.free.columns + c) += parts.held(i, k) * eigen.vector(k, c);
    const DenseMatrix combinations = multiply(loose, floating);
    for (std::int64_t c = 0; c < combinations.columns; ++c) {
        const std::span<const double> combination =
            std::span<const double>(combinations.value).subspan(index(c * combinations.rows), index(combinations.rows));
        (c < parts.free.columns ? free_ : weak_).push_back(in_variables(combination));
        if (c < parts.free.columns) combination_.emplace_back(combination.begin(), combination.end());
    }
    const DenseMatrix all = multiply(z, combinations);
    anchors_ = anchors_of(all);
    DenseMatrix of_free(all.rows, parts.free.columns);
    std::copy_n(all.value.begin(), of_free.value.size(), of_free.value.begin());
    free_anchors_ = anchors_of(of_free);
}

std::vector<Zone::Coupling> Floating::anchors_of(const DenseMatrix& jumps) const {
    std::vector<Zone::Coupling> anchors;
    if (jumps.columns == 0) return anchors;
    DenseMatrix across(jumps.columns, jumps.rows);
    for (std::int64_t i = 0; i < jumps.rows; ++i)
        for (std::int64_t c = 0; c < jumps.columns; ++c) across(c, i) = jumps(i, c);
    const PivotedColumns pivots = pivoted_columns(std::move(across), 1e-10);
    for (std::int64_t k = 0; k < pivots.rank; ++k) {
        const std::int64_t r = pivots.order[index(k)];
        anchors.push_back({r, r, anchored * row_diagonal(system_, index(r))});
    }
    return anchors;
}

bool Floating::balances(std::span<const double> theta, std::span<const double> row_force) const {
    std::vector<double> jump(system_.rows().size());
    for (const std::vector<double>& combination : combination_) {
        double work = 0.0, magnitude = 0.0;
        if (!row_force.empty()) multiply(rigid_.jumps(), combination, jump);
        for (std::size_t r = 0; r < row_force.size(); ++r) {
            if (held_[r] != 0 || row_force[r] == 0.0) continue;
            work += jump[r] * row_force[r];
            magnitude += std::abs(row_force[r]) * std::max(std::abs(jump[r]), rounded_load * max_abs(jump));
        }
        if (!rigid_.dead_work().balances(theta, combination, work, magnitude)) return false;
    }
    return true;
}

std::vector<double> Floating::settle(std::span<double> x) const {
    std::vector<double> added;
    if (free_.empty()) return added;
    const auto n = static_cast<std::int64_t>(free_.size());
    const std::size_t rows = system_.rows().size();
    DenseMatrix gram(n, n), right(n, 1);
    std::vector<std::vector<double>> jump(free_.size(), std::vector<double>(rows));
    for (std::size_t f = 0; f < free_.size(); ++f)
        for (std::size_t r = 0; r < rows; ++r) jump[f][r] = system_.rows().value(r, free_[f]);
    std::vector<double> now(rows);
    for (std::size_t r = 0; r < rows; ++r) now[r] = system_.rows().value(r, x);
    for (std::int64_t i = 0; i < n; ++i) {
        right(i, 0) = dot(jump[index(i)], now);
        for (std::int64_t j = 0; j < n; ++j) gram(i, j) = dot(jump[index(i)], jump[index(j)]);
    }
    if (!solve_general(gram, right, 1e-12)) return added;
    for (std::int64_t i = 0; i < n; ++i) {
        added.push_back(-right(i, 0));
        add_scaled(added.back(), free_[index(i)], x);
    }
    return added;
}

}  // namespace delam
