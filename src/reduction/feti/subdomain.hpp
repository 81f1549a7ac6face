// SPDX-License-Identifier: BSD-3-Clause
// One subdomain, condensed once onto its boundary DOFs (those that any multiplier touches).
//
// A floating subdomain's K is singular with the rigid motions R as its kernel. Holding as many DOFs as there are motions,
// chosen on the boundary by a rank-revealing QR of R, leaves a definite matrix; its inverse, padded with zeros, is a generalised inverse of K. With
// the boundary eliminated last, the trailing factor L gives both blocks that FETI lives on:
//   F_s = (K^+)_bb = (L L^T)^-1    and    S_s = L L^T,
// where the rows of S_s at the held DOFs follow from S_s R_b = 0.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "body/material.hpp"
#include "linalg/cholesky.hpp"
#include "linalg/dense.hpp"
#include "mesh/mesh.hpp"

namespace delam {

struct Subdomain {
    std::int32_t body = -1;
    std::vector<std::int64_t> nodes;     // mesh nodes, ascending; local DOF = dimension*index + component
    std::vector<std::int64_t> boundary;  // local DOFs, ascending
    std::int64_t rigid_count = 0;

    SparseMatrix stiffness;  // over all local DOFs
    DenseMatrix rigid;       // R, [local DOFs][rigid_count], orthonormal
    DenseMatrix rigid_boundary;
    DenseMatrix flexibility;        // F_s, boundary x boundary
    DenseMatrix schur;              // S_s; empty unless asked for
    std::vector<double> diagonal;   // of the stiffness at the boundary

    // Numerical set-up, after nodes, boundary and body are known.
    void condense(const Mesh& mesh, std::span<const std::int64_t> cells, const Elastic& material, Plane plane, bool with_schur);
    // x = K^+ b over all local DOFs.
    void apply_inverse(std::span<const double> b, std::span<double> x) const;
    std::int64_t dofs() const { return stiffness.rows; }

private:
    std::vector<std::int64_t> order_;  // free local DOFs: interior, then boundary
    std::unique_ptr<SparseCholesky> factor_;
};

}  // namespace delam
