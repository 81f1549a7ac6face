// SPDX-License-Identifier: BSD-3-Clause
// The natural coarse space: every subdomain must be in equilibrium, G lambda = e with G = R^T B^T.
//
// PCG runs within ker G by the projector P = I - Q G^T (G Q G^T)^-1 G. With springs of very different stiffness Q = I
// is useless (measured: hundreds of iterations); the diagonal of (F + C)^-1 is cheap and enough. Rows that carry no
// force (debonded, open) are out: their column of G counts as zero. A part that nothing holds any more leaves G Q G^T
// singular, which is legal as long as nothing loads it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "linalg/sparse/semidefinite.hpp"
#include "reduction/feti/dual/dual_rows.hpp"

namespace delam {

class CoarseProblem {
public:
    CoarseProblem(const DualRows& rows, std::span<const Subdomain> subdomains);
    // Q = diag(weight); weight 0 takes a row out.
    void set_weights(std::span<const double> weight);

    std::int64_t size() const { return g_.rows; }
    // lambda <- P lambda (forces) and r <- P^T r (jumps).
    void project(std::span<double> lambda) const;
    void project_transposed(std::span<double> r) const;
    // lambda += Q G^T (G Q G^T)^-1 (e - G lambda). Returns the largest component of e that is left over, relative to
    // `scale`.
    double balance(std::span<const double> e, std::span<double> lambda, double scale) const;
    // Rigid-body coefficients from the residual r = A lambda - b = G^T alpha.
    std::vector<double> rigid_coefficients(std::span<const double> r) const;
    // G lambda, [coarse], and G^T alpha, [rows].
    std::vector<double> apply(std::span<const double> lambda) const;
    std::vector<double> apply_transposed(std::span<const double> alpha) const;

private:
    SparseMatrix g_;   // [coarse][rows]
    SparseMatrix gt_;  // [rows][coarse]
    std::vector<double> weight_;
    SemidefiniteFactor factor_;
};

}  // namespace delam
