// SPDX-License-Identifier: BSD-3-Clause
// The bodies with what acts on their interfaces at the moment, sparse, in the variables of jump_variables.hpp:
//
//   minimise  1/2 v^T A v - g^T v,   A = T^T K T + N^T C N,   subject to  N_r v = -o_r on held rows,  E v = d
//
// (j = N v + o: jump rows; C: springs, or tangents of the pairs; E: constraints on many variables).
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "base/monitor.hpp"
#include "linalg/sparse/sparse.hpp"
#include "reduction/operator/body_system.hpp"
#include "reduction/operator/zone.hpp"
#include "reduction/sparse/jump_rows.hpp"
#include "reduction/sparse/reduced_space.hpp"

namespace delam {

class JumpSystem {
public:
    // transformed: T^T K T of the bodies
    JumpSystem(const BodySystem& bodies, SparseMatrix transformed, const Poll& poll);
    // Has the trailing variables alone, those of all rows and constraints, for bodies that somebody else solves:
    // functions that multiply by T^T K T do not apply. The diagonal comes later.
    explicit JumpSystem(const BodySystem& bodies);
    JumpSystem(const JumpSystem&) = delete;
    JumpSystem& operator=(const JumpSystem&) = delete;
    void set_diagonal(std::vector<double> diagonal) { diagonal_ = std::move(diagonal); }

    const Limits& limits() const { return limits_; }
    std::int64_t count() const { return matrix_.rows; }
    // The first of the variables of jump_variables.hpp that this system has.
    std::int64_t first() const { return first_; }
    // T^T K T; entries exist for all variables that a pair's rows connect.
    const SparseMatrix& matrix() const { return matrix_; }
    // The matrix with these entries added, for the time of a call. They must be entries of its pattern.
    void with_added(std::span<const Triplet> entries, const std::function<void(const SparseMatrix&)>& use);
    std::span<const double> diagonal() const { return diagonal_; }
    const JumpRows& rows() const { return rows_; }

    // Sets the couplings from now on, on rows that are not held. held: [rows]; prescribed rows are never held.
    void set(std::vector<Zone::Coupling> couplings, std::span<const std::uint8_t> held);
    const std::vector<Zone::Coupling>& couplings() const { return couplings_; }
    const std::vector<std::uint8_t>& held() const { return space_.held(); }
    const ReducedSpace& space() const { return space_; }

    // y = A x over all variables.
    void apply(std::span<const double> x, std::span<double> y) const;
    // The same for an x that is zero nearly everywhere.
    void apply_sparse(std::span<const double> x, std::span<double> y) const;
    // The same in the variables that `wanted` marks and in those that gather() adds to them; elsewhere y is not
    // defined.
    void apply(std::span<const double> x, std::span<double> y, std::span<const std::uint8_t> wanted) const;
    // The same, and the sizes of the terms of which each component is the sum.
    void apply(std::span<const double> x, std::span<double> y, std::span<double> size) const;
    // y = T^T K T x where multipliers() reads what is left over; elsewhere zero.
    void multiply_held(std::span<const double> x, std::span<double> y) const;
    // Adds C N x as forces on all variables to y.
    void add_couplings(std::span<const double> x, std::span<double> y) const;

private:
    double matrix_row(std::size_t i, std::span<const double> x) const;

    const Limits& limits_;
    std::int64_t first_ = 0;
    SparseMatrix matrix_;
    std::vector<double> diagonal_;
    JumpRows rows_;
    std::vector<Zone::Coupling> couplings_;
    ReducedSpace space_;
};

}  // namespace delam
