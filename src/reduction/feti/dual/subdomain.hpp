// SPDX-License-Identifier: BSD-3-Clause
// One subdomain, condensed once onto its boundary DOFs (those that any multiplier touches).
//
// A floating subdomain's K is singular with the rigid motions R as its kernel. With a shift tau on the boundary's
// diagonal it is definite, and with the boundary eliminated last the trailing factor L gives the Schur complement: S_s
// = L L^T - tau I. Then
//   F_s = (S_s + rho Q Q^T)^-1,  Q: orthonormal basis of R_b,
// is a generalised inverse on the boundary that favours no DOF. (Holding as many DOFs as there are motions is cheaper,
// but rounding in K R then ends as a false force at the held DOFs: measured 3e-10 of the reactions on a 120 mm ply.)
// The interior follows from the boundary: u_i = K_ii^-1 (f_i - K_ib u_b).
//
// All control nodes together are one more subdomain, without cells: K = 0, every DOF on the boundary and a motion of
// its own (R = I up to scale), no flexibility. The coarse problem then states their equilibrium.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "linalg/dense/dense.hpp"
#include "linalg/sparse/cholesky.hpp"

namespace delam {

struct Subdomain {
    std::int32_t body = -1;              // -1: control nodes
    std::vector<std::int64_t> nodes;     // mesh nodes, ascending; local DOF = dimension*index + component
    std::vector<std::int64_t> boundary;  // local DOFs, ascending
    std::int64_t rigid_count =
        0;  // motions without energy: 3 or 6, fewer where the host's stiffness has supports of its own

    SparseMatrix stiffness;  // over all local DOFs
    DenseMatrix rigid;       // R, [local DOFs][rigid_count], orthonormal
    DenseMatrix rigid_boundary;
    DenseMatrix flexibility;       // F_s, boundary x boundary
    DenseMatrix schur;             // S_s; empty unless asked for
    std::vector<double> diagonal;  // of the stiffness at the boundary

    // Numerical set-up, after stiffness, rigid, nodes, boundary and body are known. label: of the body, for messages.
    void condense(std::int32_t label, bool with_schur, const Poll& poll = {});
    // The subdomain of the control nodes, instead. scale: of each DOF's motion.
    void hold_controls(std::span<const double> scale);
    // u over all local DOFs from its boundary values, in equilibrium with f inside. f: local DOFs, only the interior is
    // read.
    std::vector<double> extend(std::span<const double> boundary_values, std::span<const double> f) const;
    // Forces on the interior carried to the boundary: f_b - K_bi K_ii^-1 f_i.
    std::vector<double> condense_load(std::span<const double> f) const;
    // f_i^T K_ii^-1 g_i, what loads inside do while the boundary is held.
    double interior_work(std::span<const double> f, std::span<const double> g) const;
    std::int64_t dofs() const { return stiffness.rows; }

private:
    // K_ii^-1 of the interior entries of g, [interior DOFs].
    std::vector<double> solve_interior(std::span<const double> g) const;

    std::vector<std::int64_t> interior_;  // local DOFs
    std::unique_ptr<SparseCholesky> factor_;
};

}  // namespace delam
