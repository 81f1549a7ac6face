// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/feti/dual/preconditioner.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "linalg/sparse/block.hpp"

namespace delam {

namespace {

// K restricted to the boundary.
SparseMatrix boundary_block(const Subdomain& s) {
    std::vector<std::int64_t> position(index(s.dofs()), -1);
    for (std::size_t i = 0; i < s.boundary.size(); ++i) position[index(s.boundary[i])] = static_cast<std::int64_t>(i);
    std::vector<Triplet> triplets;
    for (std::size_t i = 0; i < s.boundary.size(); ++i) {
        const std::size_t row = index(s.boundary[i]);
        for (std::int64_t e = s.stiffness.start[row]; e < s.stiffness.start[row + 1]; ++e) {
            const std::int64_t column = position[index(s.stiffness.column[index(e)])];
            if (column >= 0) triplets.push_back({static_cast<std::int64_t>(i), column, s.stiffness.value[index(e)]});
        }
    }
    const auto n = static_cast<std::int64_t>(s.boundary.size());
    return from_triplets(n, n, std::move(triplets));
}

constexpr std::int64_t rows_per_poll = 256;
// Part of the largest stiffness of a row that is rounding. (Measured by verify/bench/constants.py on 250 random scenes:
// half, twice and a hundred times change 3 analyses in their last digits; a hundredth is below rounding, and seed 113
// ends elsewhere.)
constexpr double rounding_of_stiffness = 1e-14;

// Zeros where rows are coupled: the diagonal, and all rows of a group (ascending) with each other.
SparseMatrix coupled(std::int64_t count, const std::vector<std::vector<std::int64_t>>& groups, const Poll& poll) {
    std::vector<std::vector<std::size_t>> groups_of(index(count));
    for (std::size_t g = 0; g < groups.size(); ++g)
        for (const std::int64_t r : groups[g]) groups_of[index(r)].push_back(g);
    SparseMatrix m;
    m.rows = m.columns = count;
    m.start.assign(1, 0);
    std::vector<std::int64_t> row, both;
    for (std::int64_t r = 0; r < count; ++r) {
        row.assign(1, r);
        for (const std::size_t g : groups_of[index(r)]) {
            both.clear();
            std::set_union(row.begin(), row.end(), groups[g].begin(), groups[g].end(), std::back_inserter(both));
            row.swap(both);
        }
        m.column.insert(m.column.end(), row.begin(), row.end());
        m.start.push_back(static_cast<std::int64_t>(m.column.size()));
        if (r % rows_per_poll == 0) call_if_set(poll);
    }
    m.value.assign(m.column.size(), 0.0);
    return m;
}

}  // namespace

FetiPreconditioner::FetiPreconditioner(const DualRows& rows, const std::vector<Subdomain>& subdomains,
                                       const Scaling& scaling, const std::string& kind, const Poll& poll)
    : rows_(rows), subdomains_(subdomains), scaling_(scaling) {
    kind_ = kind == "none"        ? Kind::none
            : kind == "lumped"    ? Kind::lumped
            : kind == "dirichlet" ? Kind::dirichlet
                                  : Kind::series;
    if (kind_ == Kind::none) return;
    scaled_transposed_ = transpose(scaling_.b_d);
    if (kind_ == Kind::lumped)
        for (const Subdomain& s : subdomains_) lumped_.push_back(boundary_block(s));
    if (kind_ == Kind::series) build_pattern(poll);
}

// base = E^T S~ E, assembled subdomain by subdomain from the jump rows that meet it: W S W^T with W the subdomain's
// part of E^T B_D. A row has one entry in W where two nodes are paired, but all of a face's where nodes are tied to
// faces: two products, not a double sum.
void FetiPreconditioner::build_pattern(const Poll& poll) {
    struct Touch {
        std::int64_t row;  // position among the rows that meet the subdomain
        std::int64_t dof;
        double value;
    };
    std::vector<std::vector<Touch>> touched(subdomains_.size());
    std::vector<std::vector<std::int64_t>> groups(
        subdomains_.size());  // rows that couple: those that meet a subdomain, ascending
    for (std::size_t s = 0; s < subdomains_.size(); ++s) {
        std::vector<std::int64_t>& met = groups[s];
        for (std::int64_t d = rows_.offset[s]; d < rows_.offset[s + 1]; ++d)
            for (std::int64_t e = scaled_transposed_.start[index(d)]; e < scaled_transposed_.start[index(d) + 1]; ++e)
                if (scaled_transposed_.column[index(e)] < rows_.jump_count) {
                    touched[s].push_back(
                        {scaled_transposed_.column[index(e)], d - rows_.offset[s], scaled_transposed_.value[index(e)]});
                    met.push_back(touched[s].back().row);
                }
        std::sort(met.begin(), met.end());
        met.erase(std::unique(met.begin(), met.end()), met.end());
        for (Touch& t : touched[s]) t.row = std::lower_bound(met.begin(), met.end(), t.row) - met.begin();
    }
    for (const auto& dependency : scaling_.dependencies) {  // room for z z^T
        std::vector<std::int64_t>& among = groups.emplace_back(dependency.row);
        std::erase_if(among, [this](std::int64_t r) { return r >= rows_.jump_count; });
        std::sort(among.begin(), among.end());
    }
    base_ = coupled(rows_.jump_count, groups, poll);
    for (std::size_t s = 0; s < subdomains_.size(); ++s) {
        const std::vector<std::int64_t>& met = groups[s];
        const auto rows = static_cast<std::int64_t>(met.size());
        DenseMatrix half(subdomains_[s].schur.rows, rows);  // S W^T
        std::vector<double> row(met.size());                // of W S W^T
        for (const Touch& t : touched[s])
            for (std::int64_t i = 0; i < half.rows; ++i) half(i, t.row) += t.value * subdomains_[s].schur(i, t.dof);
        call_if_set(poll);
        for (std::int64_t j = 0; j < rows; ++j) {
            std::fill(row.begin(), row.end(), 0.0);
            for (const Touch& t : touched[s]) row[index(t.row)] += t.value * half(t.dof, j);
            std::int64_t e = base_.start[index(met[index(j)])];
            for (std::size_t i = 0; i < met.size(); ++i) {
                while (base_.column[index(e)] < met[i]) ++e;
                base_.value[index(e)] += row[i];
            }
            if (j % rows_per_poll == 0) call_if_set(poll);
        }
    }
    call_if_set(poll);
    t_ = base_;
    t_factor_ = std::make_unique<SparseCholesky>(t_, 0, poll);
}

void FetiPreconditioner::update(const Springs& springs) {
    if (kind_ == Kind::none) return;
    if (springs.stiffness == current_.stiffness && springs.held == current_.held) return;
    current_ = Springs();  // none, until all that follows is there: it may be interrupted
    in_e_.assign(index(rows_.jump_count), 0);
    for (std::int64_t r = 0; r < rows_.jump_count; ++r) in_e_[index(r)] = springs.held[index(r)] == 0 ? 1 : 0;

    // The bodies are rigid on a dependent direction z (B^T z = 0), and springs alone decide: z^T C z. The series form
    // has S~^-1 -> 0 there: S~ gets z z^T / delta with a delta well below the compliance of springs and bodies. The
    // others get z z^T / (z^T C z) itself.
    dependency_weight_.assign(scaling_.dependencies.size(), 0.0);
    for (std::size_t k = 0; k < scaling_.dependencies.size(); ++k) {
        const auto& dependency = scaling_.dependencies[k];
        double stiffest = dependency.stiffness, compliance = 0.0;
        for (std::size_t i = 0; i < dependency.row.size(); ++i) {
            const std::int64_t r = dependency.row[i];
            if (r >= rows_.jump_count || in_e_[index(r)] == 0) continue;
            stiffest = std::max(stiffest, springs.stiffness[index(r)]);
            compliance +=
                dependency.z[i] * dependency.z[i] / springs.stiffness[index(r)];  // infinite: z carries no force
        }
        dependency_weight_[k] = kind_ == Kind::series ? 1e3 * stiffest : compliance > 0.0 ? 1.0 / compliance : 0.0;
    }
    if (kind_ == Kind::series) factorise(springs);
    current_ = springs;
}

// T of the series form.
void FetiPreconditioner::factorise(const Springs& springs) {
    t_.value = base_.value;
    const auto entry = [this](std::int64_t i, std::int64_t j) -> double& {
        const auto begin = t_.column.begin() + t_.start[index(i)], end = t_.column.begin() + t_.start[index(i) + 1];
        return t_.value[index(std::lower_bound(begin, end, j) - t_.column.begin())];
    };
    for (std::size_t k = 0; k < scaling_.dependencies.size(); ++k) {
        const auto& d = scaling_.dependencies[k];
        for (std::size_t i = 0; i < d.row.size(); ++i)
            for (std::size_t j = 0; j < d.row.size(); ++j)
                if (d.row[i] < rows_.jump_count && d.row[j] < rows_.jump_count)
                    entry(d.row[i], d.row[j]) += dependency_weight_[k] * d.z[i] * d.z[j];
    }
    for (std::int64_t r = 0; r < rows_.jump_count; ++r) {
        const bool in = in_e_[index(r)] != 0;
        for (std::int64_t e = t_.start[index(r)]; e < t_.start[index(r) + 1]; ++e)
            if (!in || in_e_[index(t_.column[index(e)])] == 0) t_.value[index(e)] = 0.0;
        entry(r, r) = in ? entry(r, r) + springs.stiffness[index(r)] : 1.0;
    }
    // S~ is blind to motions that no other row resists; a shift far below anything that matters keeps T definite. The
    // only row of a part that floats, which touches others in one point, has no stiffness at all.
    std::vector<double> diagonal(index(rows_.jump_count));
    for (std::int64_t r = 0; r < rows_.jump_count; ++r) diagonal[index(r)] = entry(r, r);
    const double least = rounding_of_stiffness * max_abs(diagonal);
    for (double& d : diagonal) d = std::max(d, least);
    double shift = 1e-14;
    while (true) {
        for (std::int64_t r = 0; r < rows_.jump_count; ++r) entry(r, r) = diagonal[index(r)] * (1.0 + shift);
        if (t_factor_->factorise(t_)) break;
        shift *= 100.0;
        if (shift > 1e-2) fail(DELAM_ERROR_NUMERICAL, "the series preconditioner is not positive definite");
    }
}

// z = S~ r (or its lumped form), dependent directions included.
void FetiPreconditioner::apply_scaled(Team& team, std::span<const double> r, std::span<double> z) const {
    std::vector<double> u(index(rows_.boundary_count())), f(u.size());
    multiply(scaled_transposed_, r, u);
    team.run(static_cast<std::int64_t>(subdomains_.size()), [&](std::int64_t i) {
        const std::size_t s = index(i), first = index(rows_.offset[s]), size = subdomains_[s].boundary.size();
        const auto in = std::span<const double>(u).subspan(first, size);
        const auto out = std::span<double>(f).subspan(first, size);
        if (kind_ == Kind::lumped)
            multiply(lumped_[s], in, out);
        else
            multiply_symmetric(subdomains_[s].schur, in, out);
    });
    multiply(scaling_.b_d, f, z);
    add_dependencies(r, z);
}

void FetiPreconditioner::apply_scaled(Team& team, const DenseMatrix& r, DenseMatrix& z) const {
    DenseMatrix u(rows_.boundary_count(), r.columns), f(u.rows, u.columns);
    multiply_columns(scaled_transposed_, r, u);
    team.run(static_cast<std::int64_t>(subdomains_.size()), [&](std::int64_t s) {
        const std::size_t first = index(rows_.offset[index(s)]), size = subdomains_[index(s)].boundary.size();
        if (kind_ != Kind::lumped) return multiply_rows(subdomains_[index(s)].schur, u, rows_.offset[index(s)], f);
        for (std::int64_t c = 0; c < u.columns; ++c)
            multiply(lumped_[index(s)], column(std::as_const(u), c).subspan(first, size),
                     column(f, c).subspan(first, size));
    });
    multiply_columns(scaling_.b_d, f, z);
    for (std::int64_t c = 0; c < r.columns; ++c) add_dependencies(column(r, c), column(z, c));
}

void FetiPreconditioner::add_dependencies(std::span<const double> r, std::span<double> z) const {
    for (std::size_t k = 0; k < dependency_weight_.size(); ++k) {
        const auto& d = scaling_.dependencies[k];
        double along = 0.0;
        for (std::size_t i = 0; i < d.row.size(); ++i) along += d.z[i] * r[index(d.row[i])];
        for (std::size_t i = 0; i < d.row.size(); ++i) z[index(d.row[i])] += dependency_weight_[k] * along * d.z[i];
    }
}

void FetiPreconditioner::apply(Team& team, std::span<const double> r, std::span<double> z) const {
    if (kind_ == Kind::none) {
        std::copy(r.begin(), r.end(), z.begin());
        return;
    }
    apply_scaled(team, r, z);
    if (kind_ != Kind::series) return;
    // z = S~ (r - E x) with T x = E^T S~ r; on the rows of E that is C^-1 x, free of cancellation.
    std::vector<double> x(index(rows_.jump_count), 0.0), y(index(rows_.jump_count));
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = in_e_[i] != 0 ? z[i] : 0.0;
    t_factor_->solve(y, x);
    std::vector<double> rest(r.begin(), r.end());
    for (std::size_t i = 0; i < x.size(); ++i)
        if (in_e_[i] != 0) rest[i] -= x[i];
    apply_scaled(team, rest, z);
    for (std::size_t i = 0; i < x.size(); ++i)
        if (in_e_[i] != 0) z[i] = current_.stiffness[i] * x[i];
}

void FetiPreconditioner::apply(Team& team, const DenseMatrix& r, DenseMatrix& z) const {
    if (kind_ == Kind::none) {
        z.value = r.value;
        return;
    }
    apply_scaled(team, r, z);
    if (kind_ != Kind::series) return;
    DenseMatrix y(rows_.jump_count, r.columns), x = y;
    for (std::int64_t c = 0; c < r.columns; ++c)
        for (std::int64_t i = 0; i < y.rows; ++i) y(i, c) = in_e_[index(i)] != 0 ? z(i, c) : 0.0;
    t_factor_->solve(y.value, x.value);
    DenseMatrix rest = r;
    for (std::int64_t c = 0; c < r.columns; ++c)
        for (std::int64_t i = 0; i < y.rows; ++i)
            if (in_e_[index(i)] != 0) rest(i, c) -= x(i, c);
    apply_scaled(team, rest, z);
    for (std::int64_t c = 0; c < r.columns; ++c)
        for (std::int64_t i = 0; i < y.rows; ++i)
            if (in_e_[index(i)] != 0) z(i, c) = current_.stiffness[index(i)] * x(i, c);
}

}  // namespace delam
