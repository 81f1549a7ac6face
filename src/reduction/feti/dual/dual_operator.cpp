// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/feti/dual/dual_operator.hpp"

#include <algorithm>

#include "base/numbers.hpp"
#include "linalg/sparse/block.hpp"

namespace delam {

DualOperator::DualOperator(DualRows rows, const std::vector<Subdomain>& subdomains, const Options& options,
                           const Poll& poll)
    : rows_(std::move(rows)), subdomains_(subdomains), preconditioned_(options.preconditioner != "none") {
    call_if_set(poll);
    b_transposed_ = transpose(rows_.b);
    scaling_ = make_scaling(rows_, subdomains_, options.scaling);
    call_if_set(poll);
    preconditioner_ = std::make_unique<FetiPreconditioner>(rows_, subdomains_, scaling_, options.preconditioner, poll);
    call_if_set(poll);
    coarse_ = std::make_unique<CoarseProblem>(rows_, subdomains_);
    find_diagonal(poll);
}

void DualOperator::find_diagonal(const Poll& poll) {
    flexibility_diagonal_.assign(index(rows_.count()), 0.0);
    const auto owner = [&](std::int64_t dof) {
        return index(std::upper_bound(rows_.offset.begin(), rows_.offset.end(), dof) - rows_.offset.begin()) - 1;
    };
    for (std::int64_t r = 0; r < rows_.b.rows; ++r) {
        if (r % 1024 == 0) call_if_set(poll);
        for (std::int64_t begin = rows_.b.start[index(r)], end = begin; begin < rows_.b.start[index(r) + 1];
             begin = end) {
            const std::size_t s = owner(rows_.b.column[index(begin)]);
            const std::int64_t first = rows_.offset[s], last = rows_.offset[s + 1];
            while (end < rows_.b.start[index(r) + 1] && rows_.b.column[index(end)] < last) ++end;
            for (std::int64_t i = begin; i < end; ++i)
                for (std::int64_t j = begin; j < end; ++j)
                    flexibility_diagonal_[index(r)] +=
                        rows_.b.value[index(i)] * rows_.b.value[index(j)] *
                        subdomains_[s].flexibility(rows_.b.column[index(i)] - first, rows_.b.column[index(j)] - first);
        }
    }
    // Rows among control nodes alone know no flexibility; the coarse problem decides their forces, whatever their
    // weight.
    double sum = 0.0;
    std::int64_t known = 0;
    for (const double f : flexibility_diagonal_) {
        sum += f;
        known += f > 0.0 ? 1 : 0;
    }
    for (double& f : flexibility_diagonal_)
        if (!(f > 0.0)) f = known > 0 ? sum / static_cast<double>(known) : 1.0;
}

void DualOperator::set(const Springs& springs) {
    const std::size_t rows = index(rows_.count());
    Springs unknown = springs;
    for (const Scaling::Prescribed& p : scaling_.prescribed_jumps) {
        unknown.stiffness[index(p.jump_row)] = 0.0;
        unknown.held[index(p.jump_row)] = 0;
    }
    compliance_.assign(rows, 0.0);
    weight_.assign(rows, 0.0);
    active_.assign(rows, 1);
    for (std::size_t i = 0; i < index(rows_.jump_count); ++i) {
        if (unknown.held[i] != 0) continue;
        if (unknown.stiffness[i] > 0.0)
            compliance_[i] = 1.0 / unknown.stiffness[i];
        else
            active_[i] = 0;
    }
    for (std::size_t i = 0; i < rows; ++i)
        weight_[i] = active_[i] != 0 ? 1.0 / (flexibility_diagonal_[i] + compliance_[i]) : 0.0;
    coarse_->set_weights(weight_);
    preconditioner_->update(unknown);
}

void DualOperator::mask(std::span<double> x) const {
    for (std::size_t i = 0; i < x.size(); ++i)
        if (active_[i] == 0) x[i] = 0.0;
}

void DualOperator::flexibility(Team& team, std::span<const double> lambda, std::span<double> jumps) const {
    std::vector<double> f(index(rows_.boundary_count())), u(f.size());
    multiply(b_transposed_, lambda, f);
    const auto apply = [&](std::int64_t i) {
        const std::size_t s = index(i), first = index(rows_.offset[s]), size = subdomains_[s].boundary.size();
        multiply_symmetric(subdomains_[s].flexibility, std::span<const double>(f).subspan(first, size),
                           std::span<double>(u).subspan(first, size));
    };
    team.run(static_cast<std::int64_t>(subdomains_.size()), apply);
    multiply(rows_.b, u, jumps);
}

void DualOperator::apply(Team& team, std::span<const double> lambda, std::span<double> jumps) const {
    flexibility(team, lambda, jumps);
    for (std::size_t i = 0; i < jumps.size(); ++i)
        jumps[i] = active_[i] != 0 ? jumps[i] + compliance_[i] * lambda[i] : 0.0;
}

double DualOperator::unit() const { return max_abs(weight_); }

void DualOperator::precondition(Team& team, std::span<const double> jumps, std::span<double> lambda) const {
    preconditioner_->apply(team, jumps, lambda);
    if (!preconditioned_) {
        const double scale = unit();
        for (double& v : lambda) v *= scale;
    }
    mask(lambda);
}

void DualOperator::flexibility(Team& team, const DenseMatrix& lambda, DenseMatrix& jumps) const {
    DenseMatrix f(rows_.boundary_count(), lambda.columns), u(f.rows, f.columns);
    multiply_columns(b_transposed_, lambda, f);
    team.run(static_cast<std::int64_t>(subdomains_.size()),
             [&](std::int64_t s) { multiply_rows(subdomains_[index(s)].flexibility, f, rows_.offset[index(s)], u); });
    multiply_columns(rows_.b, u, jumps);
}

void DualOperator::apply(Team& team, const DenseMatrix& lambda, DenseMatrix& jumps) const {
    flexibility(team, lambda, jumps);
    for (std::int64_t c = 0; c < jumps.columns; ++c)
        for (std::int64_t i = 0; i < jumps.rows; ++i)
            jumps(i, c) = active(index(i)) ? jumps(i, c) + compliance_[index(i)] * lambda(i, c) : 0.0;
}

void DualOperator::precondition(Team& team, const DenseMatrix& jumps, DenseMatrix& lambda) const {
    preconditioner_->apply(team, jumps, lambda);
    const double scale = preconditioned_ ? 1.0 : unit();
    for (std::int64_t c = 0; c < lambda.columns; ++c)
        for (std::int64_t i = 0; i < lambda.rows; ++i) lambda(i, c) = active(index(i)) ? scale * lambda(i, c) : 0.0;
}

}  // namespace delam
