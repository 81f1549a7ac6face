// SPDX-License-Identifier: BSD-3-Clause
// The bodies with what acts on their interfaces at the moment, sparse, in the variables of jump_variables.hpp:
//
//   minimise  1/2 v^T A v - g^T v,   A = T^T K T + N^T C N,   subject to  N_r v = -o_r on held rows,  E v = d
//
// (j = N v + o: jump rows; C: springs, or tangents of the pairs; E: constraints on many variables). A held row that is
// a variable of its own removes it. Each other held row, and each constraint, expresses one variable by others; vectors
// of the reduced space have zeros in the place of removed and expressed variables. Constraints come first: a held row
// that they leave no choice yields, has no force, and its jump is what they say.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "base/monitor.hpp"
#include "linalg/sparse/cholesky.hpp"
#include "reduction/operator/body_system.hpp"
#include "reduction/operator/jump_row.hpp"
#include "reduction/operator/zone.hpp"

namespace delam {

class JumpSystem {
public:
    // transformed: T^T K T of the bodies
    JumpSystem(const BodySystem& bodies, SparseMatrix transformed, const Poll& poll);
    // Has the trailing variables alone, those of all rows and constraints, for bodies that somebody else solves:
    // functions that multiply by T^T K T do not apply. The diagonal comes later.
    explicit JumpSystem(const BodySystem& bodies);
    void set_diagonal(std::vector<double> diagonal) { diagonal_ = std::move(diagonal); }

    const Limits& limits() const { return limits_; }
    std::int64_t count() const { return matrix_.rows; }
    // T^T K T; entries exist for all variables that a pair's rows connect.
    const SparseMatrix& matrix() const { return matrix_; }
    // The matrix with these entries added, for the time of a call. They must be entries of its pattern.
    void with_added(std::span<const Triplet> entries, const std::function<void(const SparseMatrix&)>& use);
    std::span<const double> diagonal() const { return diagonal_; }
    // All jump rows, in variables. Prescribed ones have none left; their offset is the jump.
    const std::vector<JumpRow>& rows() const { return rows_; }
    std::span<const std::uint8_t> prescribed() const { return prescribed_; }
    // Constraints on many variables, independent: E, in variables. The first of each occurs in no other.
    const std::vector<SparseVector>& equations() const { return equations_; }

    // d of such a constraint, [patterns]
    const std::vector<double>& equation_right(std::size_t e) const { return equation_right_[e]; }

    // Sets the couplings from now on, on rows that are not held. held: [rows]; prescribed rows are never held.
    void set(std::vector<Zone::Coupling> couplings, std::span<const std::uint8_t> held);
    const std::vector<Zone::Coupling>& couplings() const { return couplings_; }
    const std::vector<std::uint8_t>& held() const { return held_; }

    // A variable that held rows or constraints express by others.
    struct Slave {
        std::int64_t pivot;
        SparseVector masters;
        std::vector<double> right;  // [patterns]
    };
    const std::vector<Slave>& slaves() const { return slaves_; }
    const std::vector<std::int64_t>& removed() const { return removed_; }
    // The first of the variables of jump_variables.hpp that this system has.
    std::int64_t first() const { return first_; }

    // o, [rows]
    std::vector<double> offsets(std::span<const double> theta) const;
    // x: zero in removed variables, expressed ones from the others; with theta, the rest of their expressions.
    void spread(std::span<double> x) const;
    void spread(std::span<double> x, std::span<const double> theta) const;
    // Zeros in the place of removed and expressed variables.
    void reduce(std::span<double> x) const;
    // The transposed of spread(): forces on all variables become forces of the reduced space.
    void gather(std::span<double> force) const;
    // The same for sizes of forces, which do not cancel.
    void gather_sizes(std::span<double> size) const;
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
    // y = C N x as forces on all variables, added to y; and N x of all rows.
    void add_couplings(std::span<const double> x, std::span<double> y) const;
    double row_value(std::size_t row, std::span<const double> x) const;
    void add_row(std::size_t row, double factor, std::span<double> force) const;
    // Forces of held rows from those that are left over on the variables, left = sum over held rows N_r^T force_r +
    // E^T mu. Adds to force; returns mu. Consumes left.
    std::vector<double> multipliers(std::span<double> left, std::span<double> force) const;

private:
    double matrix_row(std::size_t i, std::span<const double> x) const;
    void express_rows(const BodySystem& bodies);
    void hold();
    void bind(std::span<const std::int64_t> others, std::vector<std::uint8_t>& out);
    void factor_binding() const;

    const Limits& limits_;
    std::size_t patterns_;
    std::int64_t first_ = 0;
    SparseMatrix matrix_;
    std::vector<double> diagonal_;
    std::vector<JumpRow> rows_;
    std::vector<std::uint8_t> prescribed_;
    std::vector<std::int64_t> plain_;   // [rows] the variable that this row is, -1: none
    std::vector<std::int64_t> row_of_;  // [variables] the other way round
    std::vector<SparseVector> equations_;
    std::vector<std::vector<double>> equation_right_;  // [equations][patterns]

    std::vector<Zone::Coupling> couplings_;
    std::vector<std::uint8_t> held_;
    bool known_ = false;
    std::vector<std::int64_t> removed_;
    std::vector<Slave> slaves_;
    // Independent ones among the equations (-1 - e) and the held rows that are no variable of their own (r).
    std::vector<std::int64_t> binding_;
    std::vector<SparseVector> binding_terms_;
    mutable std::unique_ptr<SparseCholesky> gram_;  // of binding_terms_, once it is needed
};

}  // namespace delam
