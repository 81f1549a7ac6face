// SPDX-License-Identifier: BSD-3-Clause
// The space that held rows and constraints leave, N_r v = -o_r and E v = d. A held row that is a variable of its own
// removes it. Each other held row, and each constraint, expresses one variable by others; vectors of the reduced space
// have zeros in the place of removed and expressed variables. Constraints come first: a held row that they leave no
// choice yields, has no force, and its jump is what they say.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "linalg/sparse/cholesky.hpp"
#include "reduction/sparse/jump_rows.hpp"

namespace delam {

class ReducedSpace {
public:
    // `rows` must outlive it. count: of the variables.
    ReducedSpace(const JumpRows& rows, std::int64_t count) : rows_(rows), count_(count) {}

    // Holds these rows from now on, [rows].
    void hold(std::span<const std::uint8_t> held);
    const std::vector<std::uint8_t>& held() const { return held_; }

    // A variable that held rows or constraints express by others.
    struct Slave {
        std::int64_t pivot;
        SparseVector masters;
        std::vector<double> right;  // [patterns]
    };
    const std::vector<Slave>& slaves() const { return slaves_; }
    const std::vector<std::int64_t>& removed() const { return removed_; }
    // Returns the terms of constraints and of held rows that are no variable of their own, without removed variables.
    const std::vector<SparseVector>& binding_terms() const { return binding_terms_; }

    // Sets removed variables of x to zero and expressed ones from the others; with theta, the rest of their
    // expressions, too.
    void spread(std::span<double> x) const;
    void spread(std::span<double> x, std::span<const double> theta) const;
    // Puts zeros in the place of removed and expressed variables.
    void reduce(std::span<double> x) const;
    // Does the transposed of spread(): forces on all variables become forces of the reduced space.
    void gather(std::span<double> force) const;
    // Does the same for sizes of forces, which do not cancel.
    void gather_sizes(std::span<double> size) const;
    // Computes the forces of held rows from those that are left over on the variables, left = sum over held rows N_r^T
    // force_r + E^T mu. Adds to force; returns mu. Consumes left.
    std::vector<double> multipliers(std::span<double> left, std::span<double> force) const;

private:
    void bind(std::span<const std::int64_t> others, std::vector<std::uint8_t>& out);
    void factor_binding() const;

    const JumpRows& rows_;
    std::int64_t count_;
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
