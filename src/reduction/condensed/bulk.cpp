// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/condensed/bulk.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "base/numbers.hpp"
#include "reduction/zone/rigid_jumps.hpp"
#include "scene/carriers.hpp"
#include "scene/strain_loads.hpp"

namespace delam {

Bulk::Bulk(const Problem& problem, Monitor& monitor) : problem_(problem) {
    const Poll analysing = [&monitor] { monitor.progress("analyse", 0, 0); };
    AssembledBodies bodies = assemble_bodies(problem_, monitor);
    system_ = std::move(bodies.system);
    transformed_ = std::move(bodies.transformed);
    call_if_set(analysing);
    factor_ = std::make_unique<SparseCholesky>(transformed_, variables().trailing(), analysing);
    size_ = factor_->size();
}

AssembledBodies Bulk::release() && { return {std::move(system_), std::move(transformed_)}; }

void Bulk::condense(Monitor& monitor) {
    const Poll condensing = [&monitor] { monitor.progress("condense", 0, 0); };
    monitor.progress("factor", 0, 0);
    factorise(condensing);
    const StrainLoads strained = system_->find_loads();
    std::vector<std::vector<double>> bonded = condense_loads(condensing);
    resolve_equations(condensing);
    call_if_set(condensing);
    find_pattern_stiffness(std::move(bonded), strained, condensing);
    const DenseMatrix motions = rigid_jumps(problem_);
    rigid_ = DenseMatrix(energy().rows(), motions.columns);
    for (std::int64_t c = 0; c < motions.columns; ++c)
        for (std::int64_t i = 0; i < rigid_.rows; ++i) rigid_(i, c) = motions(row_of_unknown_[index(i)], c);
    if (!base_) balance_strains();
    recoveries_ = 0;
}

// Factors T^T K T with a shift on the trailing diagonal, which the Schur complement of the trailing variables loses
// again.
void Bulk::factorise(const Poll& poll) {
    const std::int64_t leading = variables().leading, trailing = variables().trailing();
    std::vector<double> shift(index(trailing), 0.0);
    std::vector<std::int64_t> diagonal(index(trailing));
    for (std::int64_t t = 0; t < trailing; ++t) {
        const std::int64_t r = leading + t;
        for (std::int64_t e = transformed_.start[index(r)]; e < transformed_.start[index(r) + 1]; ++e)
            if (transformed_.column[index(e)] == r) diagonal[index(t)] = e;
        shift[index(t)] = transformed_.value[index(diagonal[index(t)])];
    }
    const double largest = trailing > 0 ? *std::max_element(shift.begin(), shift.end()) : 0.0;
    for (std::int64_t t = 0; t < trailing; ++t) {
        if (!(shift[index(t)] > 0.0)) shift[index(t)] = largest > 0.0 ? largest : 1.0;
        transformed_.value[index(diagonal[index(t)])] += shift[index(t)];
    }
    ++factorisations_;
    if (!factor_->factorise(transformed_))
        fail(DELAM_ERROR_NUMERICAL,
             "the stiffness of the bonded structure is not positive definite: check supports, materials and the shapes "
             "of cells");
    transformed_ = SparseMatrix();
    call_if_set(poll);
    energy_.stiffness = lower_times_transpose(factor_->trailing_factor(), poll);
    for (std::int64_t t = 0; t < trailing; ++t) energy_.stiffness(t, t) -= shift[index(t)];
}

// With all trailing variables at zero each pattern has the displacements u_p, which are returned; the remaining forces
// K u_p - f_p act on the trailing variables.
std::vector<std::vector<double>> Bulk::condense_loads(const Poll& poll) {
    const std::int64_t leading = variables().leading, trailing = variables().trailing();
    const std::size_t patterns = problem_.patterns.size();
    const std::vector<std::vector<double>>& force = system_->force();
    energy_.load = DenseMatrix(trailing, static_cast<std::int64_t>(patterns));
    std::vector<double> nodal(index(dofs())), carried(index(variables().count()));
    std::vector<std::vector<double>> bonded;
    for (std::size_t p = 0; p < patterns; ++p) {
        std::vector<double> u = variables().lift[p];
        multiply(stiffness(), u, nodal);
        for (std::size_t i = 0; i < nodal.size(); ++i) nodal[i] = (force[p].empty() ? 0.0 : force[p][i]) - nodal[i];
        std::vector<double> v = leading_solve(nodal);
        v.resize(carried.size(), 0.0);
        system_->add_variables(v, u);
        multiply(stiffness(), u, nodal);
        for (std::size_t i = 0; i < nodal.size(); ++i) nodal[i] = (force[p].empty() ? 0.0 : force[p][i]) - nodal[i];
        multiply_transposed(variables().transform, nodal, carried);
        double squares = 0.0;
        for (std::size_t i = 0; i < index(leading); ++i) squares += carried[i] * carried[i] * v[i] * v[i];
        left_over_.push_back(std::sqrt(squares));
        std::copy(carried.begin() + leading, carried.end(),
                  energy_.load.value.begin() + static_cast<std::int64_t>(p) * trailing);
        bonded.push_back(std::move(u));
        call_if_set(poll);
    }
    return bonded;
}

// A_pq = u_p^T K u_q - f_p^T u_q - f_q^T u_p + W_pq, W of the eigenstrains: no difference of large numbers, whatever
// the lift is.
void Bulk::find_pattern_stiffness(std::vector<std::vector<double>> bonded, const StrainLoads& strained,
                                  const Poll& poll) {
    const std::size_t patterns = problem_.patterns.size();
    const std::vector<std::vector<double>>& force = system_->force();
    std::vector<double> nodal(index(dofs()));
    const std::vector<double> closed(index(energy().rows()), 0.0);
    std::vector<std::vector<double>> stressed;
    for (std::size_t p = 0; p < patterns; ++p) {
        if (variables().kept > 0 || !pivot_.empty()) {
            std::vector<double> unit(patterns, 0.0);
            unit[p] = 1.0;
            bonded[p] = displacement(unit, closed);
        }
        multiply(stiffness(), bonded[p], nodal);
        stressed.push_back(nodal);
        call_if_set(poll);
    }
    pattern_stiffness_ = DenseMatrix(static_cast<std::int64_t>(patterns), static_cast<std::int64_t>(patterns));
    for (std::size_t p = 0; p < patterns; ++p)
        for (std::size_t q = 0; q < patterns; ++q) {
            double a = dot(bonded[p], stressed[q]) + strained.energy[p * patterns + q];
            if (!force[p].empty()) a -= dot(force[p], bonded[q]);
            if (!force[q].empty()) a -= dot(force[q], bonded[p]);
            pattern_stiffness_(static_cast<std::int64_t>(p), static_cast<std::int64_t>(q)) = a;
        }
}

double Bulk::rounding_energy(std::span<const double> theta) const {
    double sum = 0.0;
    for (std::size_t p = 0; p < theta.size(); ++p) sum += theta[p] * theta[p] * left_over_[p];
    return sum;
}

// Eigenstrains do no work in rigid motions. If nothing resists these, the load along them is only rounding, and this
// removes it.
void Bulk::balance_strains() {
    const auto rows = index(rigid_.rows);
    for (std::size_t p = 0; p < problem_.patterns.size(); ++p) {
        if (problem_.patterns[p].drives != Pattern::Drives::strain) continue;
        const auto load = std::span<double>(energy_.load.value).subspan(p * rows, rows);
        for (int pass = 0; pass < 2; ++pass)
            for (std::int64_t c = 0; c < rigid_.columns; ++c) {
                const auto motion = std::span<const double>(rigid_.value).subspan(index(c) * rows, rows);
                add_scaled(-dot(motion, load), motion, load);
            }
    }
}

std::vector<double> Bulk::leading_solve(std::span<const double> nodal) const {
    std::vector<double> carried(index(variables().count())), v(index(variables().leading), 0.0);
    multiply_transposed(variables().transform, nodal, carried);
    carried.resize(v.size());
    if (std::any_of(carried.begin(), carried.end(), [](double x) { return x != 0.0; }))
        factor_->solve_leading(carried, v);
    return v;
}

std::vector<double> Bulk::displacement(std::span<const double> theta, std::span<const double> unknowns) const {
    std::vector<double> rest(rest_.size());
    if (base_)
        base_->recover(theta, unknowns, rest);
    else
        std::copy(unknowns.begin(), unknowns.end(), rest.begin());
    std::vector<double> v(index(variables().count()), 0.0), bound(pivot_.size()), driven(pivot_.size());
    multiply(bound_, rest, bound);
    multiply(prescribed_, theta, driven);
    for (std::size_t i = 0; i < rest.size(); ++i) v[index(variables().leading + rest_[i])] = rest[i];
    for (std::size_t i = 0; i < pivot_.size(); ++i) v[index(variables().leading + pivot_[i])] = bound[i] + driven[i];

    std::vector<double> u = system_->lift(theta), nodal(u.size());
    system_->add_variables(v, u);
    multiply(stiffness(), u, nodal);
    for (double& f : nodal) f = -f;
    for (std::size_t p = 0; p < theta.size(); ++p)
        if (!system_->force()[p].empty()) add_scaled(theta[p], system_->force()[p], nodal);
    poll_cancel("recover", dofs() / 64);
    std::vector<double> inside = leading_solve(nodal);
    poll_cancel("recover", dofs() / 64);
    inside.resize(v.size(), 0.0);
    system_->add_variables(inside, u);
    ++recoveries_;
    return u;
}

}  // namespace delam
