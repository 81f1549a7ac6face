// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/feti/dual/subdomain.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"

namespace delam {

namespace {

// Rows of the rigid motions at some DOFs, transposed: [motions][dofs].
DenseMatrix motions_at(const DenseMatrix& rigid, std::span<const std::int64_t> dofs) {
    DenseMatrix m(rigid.columns, static_cast<std::int64_t>(dofs.size()));
    for (std::int64_t j = 0; j < m.columns; ++j)
        for (std::int64_t r = 0; r < rigid.columns; ++r) m(r, j) = rigid(dofs[index(j)], r);
    return m;
}

// The matrix over a subset of its DOFs in a new order.
SparseMatrix permuted(const SparseMatrix& k, std::span<const std::int64_t> order) {
    std::vector<std::int64_t> position(index(k.rows), -1);
    for (std::size_t i = 0; i < order.size(); ++i) position[index(order[i])] = static_cast<std::int64_t>(i);
    SparseMatrix p;
    p.rows = p.columns = static_cast<std::int64_t>(order.size());
    p.start.assign(1, 0);
    p.start.reserve(order.size() + 1);
    std::vector<std::pair<std::int64_t, double>> row;
    for (const std::int64_t dof : order) {
        row.clear();
        for (std::int64_t e = k.start[index(dof)]; e < k.start[index(dof) + 1]; ++e) {
            const std::int64_t c = position[index(k.column[index(e)])];
            if (c >= 0) row.emplace_back(c, k.value[index(e)]);
        }
        std::sort(row.begin(), row.end());
        for (const auto& [c, v] : row) {
            p.column.push_back(c);
            p.value.push_back(v);
        }
        p.start.push_back(static_cast<std::int64_t>(p.column.size()));
    }
    return p;
}

// A rigid motion that the boundary moves by less than this part of the largest one is not held there. (Measured by
// verify/bench/constants.py on 250 random scenes: half and twice decide alike.)
constexpr double rank_tolerance = 1e-8;

}  // namespace

void Subdomain::condense(std::int32_t label, bool with_schur, const Poll& poll) {
    rigid_count = rigid.columns;
    if (boundary.empty()) boundary.push_back(0);  // nothing touches a body that the host's own supports hold

    // Where the boundary alone cannot hold the subdomain (a body touched at one point), DOFs of the interior join it.
    if (rigid_count > 0 && pivoted_columns(motions_at(rigid, boundary), rank_tolerance).rank < rigid_count) {
        std::vector<std::int64_t> all(index(stiffness.rows));
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::int64_t>(i);
        const PivotedColumns whole = pivoted_columns(motions_at(rigid, all), rank_tolerance);
        for (std::int64_t r = 0; r < rigid_count; ++r) boundary.push_back(whole.order[index(r)]);
        std::sort(boundary.begin(), boundary.end());
        boundary.erase(std::unique(boundary.begin(), boundary.end()), boundary.end());
    }
    const auto nb = static_cast<std::int64_t>(boundary.size());
    std::vector<std::uint8_t> is_boundary(index(stiffness.rows), 0);
    for (const std::int64_t d : boundary) is_boundary[index(d)] = 1;
    interior_.clear();
    for (std::int64_t d = 0; d < stiffness.rows; ++d)
        if (is_boundary[index(d)] == 0) interior_.push_back(d);
    std::vector<std::int64_t> order = interior_;
    order.insert(order.end(), boundary.begin(), boundary.end());

    rigid_boundary = DenseMatrix(nb, rigid_count);
    for (std::int64_t r = 0; r < rigid_count; ++r)
        for (std::int64_t i = 0; i < nb; ++i) rigid_boundary(i, r) = rigid(boundary[index(i)], r);
    diagonal.assign(index(nb), 0.0);
    for (std::int64_t i = 0; i < nb; ++i) {
        const auto d = index(boundary[index(i)]);
        for (std::int64_t e = stiffness.start[d]; e < stiffness.start[d + 1]; ++e)
            if (stiffness.column[index(e)] == static_cast<std::int64_t>(d))
                diagonal[index(i)] = stiffness.value[index(e)];
    }
    SparseMatrix shifted = permuted(stiffness, order);
    const double tau = *std::max_element(diagonal.begin(), diagonal.end());
    const auto ni = static_cast<std::int64_t>(interior_.size());
    for (std::int64_t r = ni; r < shifted.rows; ++r)
        for (std::int64_t e = shifted.start[index(r)]; e < shifted.start[index(r) + 1]; ++e)
            if (shifted.column[index(e)] == r) shifted.value[index(e)] += tau;
    call_if_set(poll);
    factor_ = std::make_unique<SparseCholesky>(shifted, nb, poll);
    call_if_set(poll);
    if (!factor_->factorise(shifted))
        fail(DELAM_ERROR_NUMERICAL, "the stiffness of body ", label,
             " is not positive definite beyond its rigid motions: check its material and the shapes of its cells");
    call_if_set(poll);
    schur = lower_times_transpose(factor_->trailing_factor(), poll);
    for (std::int64_t i = 0; i < nb; ++i) schur(i, i) -= tau;

    const DenseMatrix q = orthonormalised(rigid_boundary);
    const double rho = tau;  // S itself may vanish: as many boundary DOFs as rigid motions
    flexibility = schur;
    for (std::int64_t r = 0; r < rigid_count; ++r)
        for (std::int64_t j = 0; j < nb; ++j)
            for (std::int64_t i = 0; i < nb; ++i) flexibility(i, j) += rho * q(i, r) * q(j, r);
    flexibility = inverse_definite(std::move(flexibility), poll);
    if (!with_schur) schur = DenseMatrix();
}

void Subdomain::hold_controls(std::span<const double> scale) {
    const auto n = static_cast<std::int64_t>(scale.size());
    stiffness = SparseMatrix();
    stiffness.rows = stiffness.columns = n;
    stiffness.start.assign(scale.size() + 1, 0);
    rigid_count = n;
    rigid = DenseMatrix(n, n);
    boundary.resize(scale.size());
    for (std::int64_t i = 0; i < n; ++i) {
        boundary[index(i)] = i;
        rigid(i, i) = scale[index(i)];
    }
    rigid_boundary = rigid;
    flexibility = DenseMatrix(n, n);
    schur = DenseMatrix(n, n);
    diagonal.assign(scale.size(), 0.0);
}

std::vector<double> Subdomain::solve_interior(std::span<const double> g) const {
    if (interior_.empty()) return {};
    std::vector<double> b(interior_.size()), x(interior_.size());
    for (std::size_t i = 0; i < b.size(); ++i) b[i] = g[index(interior_[i])];
    factor_->solve_leading(b, x);
    return x;
}

std::vector<double> Subdomain::extend(std::span<const double> boundary_values, std::span<const double> f) const {
    std::vector<double> u(index(dofs()), 0.0), g(u.size());
    for (std::size_t i = 0; i < boundary.size(); ++i) u[index(boundary[i])] = boundary_values[i];
    multiply(stiffness, u, g);
    for (std::size_t i = 0; i < g.size(); ++i) g[i] = f[i] - g[i];
    const std::vector<double> inside = solve_interior(g);
    for (std::size_t i = 0; i < inside.size(); ++i) u[index(interior_[i])] = inside[i];
    return u;
}

std::vector<double> Subdomain::condense_load(std::span<const double> f) const {
    const std::vector<double> inside = solve_interior(f);
    std::vector<double> u(index(dofs()), 0.0), g(u.size()), condensed(boundary.size());
    for (std::size_t i = 0; i < inside.size(); ++i) u[index(interior_[i])] = inside[i];
    multiply(stiffness, u, g);
    for (std::size_t i = 0; i < boundary.size(); ++i) condensed[i] = f[index(boundary[i])] - g[index(boundary[i])];
    return condensed;
}

double Subdomain::interior_work(std::span<const double> f, std::span<const double> g) const {
    const std::vector<double> inside = solve_interior(g);
    double work = 0.0;
    for (std::size_t i = 0; i < inside.size(); ++i) work += f[index(interior_[i])] * inside[i];
    return work;
}

}  // namespace delam
