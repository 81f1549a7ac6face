// SPDX-License-Identifier: BSD-3-Clause
// The dual system as one dense factor, for scenes whose rows are few: with boundary blocks of the size of the whole,
// one factorisation costs less than the iterations of a few columns.
//
//   (F + C) lambda = right + G^T alpha,   G lambda = resultant
#pragma once

#include "reduction/feti/dual/dual_operator.hpp"

namespace delam {

class DenseDual {
public:
    // Factorises F + C with the springs that `op` has. Where F + C is singular (redundant gluing, control nodes) there
    // is no factor.
    DenseDual(const DualOperator& op, const std::vector<Subdomain>& subdomains, const Poll& poll);
    // Returns the forces by the factor; zero where there is none. Accurate to rounding unless F + C is close to
    // singular.
    DenseMatrix solve(const DenseMatrix& right, const DenseMatrix& resultant) const;

private:
    const DualOperator& op_;
    std::vector<std::int64_t> active_;  // rows that carry force
    bool definite_ = false;
    DenseMatrix factor_;  // of F + C among them
    DenseMatrix motion_;  // L^-1 G^T
    DenseMatrix coarse_;  // (G (F + C)^-1 G^T)^-1
};

}  // namespace delam
