// SPDX-License-Identifier: BSD-3-Clause
// The whole system factored at springs of an earlier moment, as a preconditioner: it stays when the springs change.
// Constraints on many variables are met exactly.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "linalg/sparse/cholesky.hpp"
#include "reduction/sparse/iterated/constraint_columns.hpp"
#include "reduction/sparse/jump_system.hpp"

namespace delam {

class WholeFactor {
public:
    WholeFactor(JumpSystem& system, const Poll& poll);
    // springs: entries of the springs of this moment. Throws Error(DELAM_ERROR_NUMERICAL) if the bodies have no
    // definite stiffness.
    void factorise(std::span<const Triplet> springs, const Poll& poll);
    void apply(std::span<const double> r, std::span<double> z) const;

    const FactorSize& size() const { return size_; }
    double entries() const { return factor_.factor_entries(); }  // as stored

private:
    JumpSystem& system_;
    SparseCholesky factor_;
    FactorSize size_;
    ConstraintColumns constraints_;
};

}  // namespace delam
