// SPDX-License-Identifier: BSD-3-Clause
// All bodies condensed onto the jumps, once.
//
// In the variables of jump_variables.hpp the stiffness is T^T K T. Its factor, with the jumps eliminated last, contains
// the Schur complement in its trailing block: S = L_tt L_tt^T - tau, where a shift tau on the trailing diagonal keeps
// the factor definite for floating bodies. Constraints that bind several unknowns are resolved in the dense stage. The
// result is an energy of the unknown jumps x,
//
//     E(theta, x) = 1/2 x^T S x - theta^T L^T x + 1/2 theta^T A theta,      jump rows  j = N x + O theta
//
// (N: the identity except for rows that close a ring of bodies or that a constraint binds; O: jumps that constraints
// prescribe).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "linalg/cholesky.hpp"
#include "reduction/body_system.hpp"
#include "reduction/zone/dense_energy.hpp"
#include "reduction/zone/jump_row.hpp"
#include "scene/problem.hpp"

namespace delam {

class Bulk {
public:
    // Assembles and analyses; condense() computes the numbers.
    Bulk(const Problem& problem, Monitor& monitor);
    void condense(Monitor& monitor);
    // Before condense(): what another realisation can go on with.
    AssembledBodies release() &&;

    const std::vector<JumpRow>& rows() const { return rows_; }
    // The first jump row that equals unknown i. Others may equal it too (on opposite faces of a periodic cell).
    const std::vector<std::int64_t>& row_of_unknown() const { return row_of_unknown_; }
    const DenseEnergy& energy() const { return base_ ? base_->energy() : energy_; }
    const DenseMatrix& pattern_stiffness() const { return pattern_stiffness_; }
    // Jumps of the rigid motions that the supports leave free, [unknowns][motions], orthonormal.
    const DenseMatrix& rigid() const { return rigid_; }

    std::vector<double> displacement(std::span<const double> theta, std::span<const double> unknowns) const;
    // Reactions and unbalanced forces.
    const BodySystem& system() const { return *system_; }

    // Energy error, F L, that the factor's rounding leaves in the displacements of the loads themselves, with the
    // unknowns at rest.
    double rounding_energy(std::span<const double> theta) const;

    std::int64_t dofs() const { return system_->dofs(); }
    const FactorSize& size() const { return size_; }  // of the factor with the jumps last
    // Before condense(): number of unknowns eliminated last, entries of K and T^T K T, numbers that the factor will
    // store.
    std::int64_t trailing() const { return variables().trailing(); }
    std::int64_t stiffness_entries() const { return stiffness().entries(); }
    std::int64_t transformed_entries() const { return transformed_.entries(); }
    double factor_entries() const { return factor_->factor_entries(); }
    const SparseMatrix& transformed() const { return transformed_; }
    std::int64_t factorisations() const { return factorisations_; }
    std::int64_t recoveries() const { return recoveries_; }  // of displacements, since condense()

private:
    void factorise(const Poll& poll);
    std::vector<std::vector<double>> condense_loads(const Poll& poll);
    void find_pattern_stiffness(std::vector<std::vector<double>> bonded, const StrainLoads& strained, const Poll& poll);
    // bulk_equations.cpp
    void resolve_equations(const Poll& poll);
    void substitute_pivots();
    void express_rows(std::span<const std::int64_t> place);
    void balance_strains();
    std::vector<double> leading_solve(std::span<const double> nodal) const;
    const JumpVariables& variables() const { return system_->variables(); }
    const SparseMatrix& stiffness() const { return system_->stiffness(); }

    const Problem& problem_;
    std::unique_ptr<BodySystem> system_;
    SparseMatrix transformed_;  // T^T K T, until it is factored
    std::unique_ptr<SparseCholesky> factor_;
    FactorSize size_;
    std::int64_t factorisations_ = 0;
    mutable std::int64_t recoveries_ = 0;
    // Trailing variables: t = M r + d theta, r = [kept ones that no equation determines | unknown jumps].
    std::vector<std::int64_t> rest_;   // trailing index of r
    std::vector<std::int64_t> pivot_;  // trailing index of variables determined by equations
    DenseMatrix bound_;                // [pivots][rest]
    DenseMatrix prescribed_;           // [pivots][patterns]
    std::int64_t kept_rest_ = 0;       // number of displacements in r

    DenseEnergy energy_;
    std::unique_ptr<Condensation> base_;
    std::vector<JumpRow> rows_;
    std::vector<std::int64_t> row_of_unknown_;
    DenseMatrix pattern_stiffness_;
    std::vector<double> left_over_;  // [patterns] work of the forces that leading_solve() left, with random signs
    DenseMatrix rigid_;
};

}  // namespace delam
