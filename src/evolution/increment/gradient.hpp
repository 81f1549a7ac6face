// SPDX-License-Identifier: BSD-3-Clause
// Gradient regularisation of the adhesion: the stored energy  kappa/2 int |grad_s zeta|^2  over an interface (Zeman,
// Kruzik, Gruber, PANM 15 (2010), "Application to delamination problem", stored energy).
//
// zeta is interpolated by the shape functions of the faces between its values at the pairs, on the geometry of face a:
//   energy = kappa/2 zeta^T A zeta,   A_ij = int grad_s N_i . grad_s N_j,   grad_s N_i . grad_s N_j = g_i^T G^-1 g_j,
// with g = dN/dxi and the metric G = (dx/dxi)^T (dx/dxi) of a line or a surface in space, by Gauss quadrature. A is the
// stiffness of the surface Laplacian (Dziuk, 1988): symmetric, its rows sum to zero.
//
// The field lives on the part of the interface that adhered at first. A function with square-integrable gradient has no
// jump, so faces that touch a pair of initial adhesion 0 (a notch) are left out, and the border of what remains carries
// the natural condition, no flux.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "linalg/sparse/cholesky.hpp"
#include "linalg/sparse/sparse.hpp"
#include "mesh/mesh.hpp"

namespace delam {

// A of an interface, [pairs][pairs], L^0 in 3D and L^-1 in 2D; every diagonal entry is stored. adhesion: initial,
// [pairs].
SparseMatrix surface_stiffness(const Mesh& mesh, const InterfaceGeometry& interface, std::span<const double> adhesion);

// The gradient term of one interface; all arrays are over its own pairs.
class GradientTerm {
public:
    // stiffness: A. weight: [pairs]. first: index of the interface's first pair among all. kappa > 0, F L.
    GradientTerm(double kappa, const SparseMatrix& stiffness, std::vector<double> weight, std::size_t first);

    double kappa() const { return kappa_; }
    std::size_t first() const { return first_; }
    std::size_t pairs() const { return weight_.size(); }
    std::span<const double> weight() const { return weight_; }
    // True if an included face touches the pair. All other pairs obey the pointwise law.
    bool coupled(std::size_t pair) const { return diagonal_[pair] > 0.0; }
    std::int64_t coupled_pairs() const;
    double diagonal(std::size_t pair) const { return diagonal_[pair]; }  // kappa A_ii

    const SparseMatrix& matrix() const { return matrix_; }  // kappa A

    double energy(std::span<const double> zeta) const;
    // kappa A zeta. From differences of zeta, so that a uniform adhesion has none, to the last digit.
    std::vector<double> force(std::span<const double> zeta) const;

    // x = (kappa A + diag)^-1 b over the pairs that are not held; x = b/(kappa A_ii + diag) for held ones. diag >= 0.
    // The pattern is that of A whatever is held, so one symbolic analysis serves all. False: not positive definite, to
    // rounding.
    bool solve(std::span<const double> diag, std::span<const std::uint8_t> held, std::span<const double> b,
               std::span<double> x) const;
    // Operations of one such solve.
    double operations() const { return factor_.size().flops + 4.0 * factor_.size().entries; }

private:
    double kappa_;
    SparseMatrix matrix_;  // kappa A
    std::vector<double> weight_;
    std::vector<double> diagonal_;
    std::size_t first_;
    mutable SparseMatrix work_;  // the pattern again, with the values of the last solve
    mutable SparseCholesky factor_;
};

}  // namespace delam
