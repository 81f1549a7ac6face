// SPDX-License-Identifier: BSD-3-Clause
// The damage step of an interface with a gradient term: pairs are coupled, and
//
//   F(z) = sum w (z Y + g(z)) + kappa/2 z^T A z    over    z_least <= z <= z_old
//
// is minimised as one convex problem. Projected Newton (Bertsekas, SIAM J. Control Optim. 20, 1982): pairs that the
// gradient presses against a bound keep to it, the others take a Newton step by a sparse Cholesky factor, and the step
// is projected and cut until the energy falls enough. Where energies differ by less than their rounding the slope
// decides (approximate Wolfe condition; Hager and Zhang, SIAM J. Optim. 16, 2005): along a segment a convex energy
// falls as long as its slope does not change sign.
//
// g'' of a brittle law ranges over (Gc/Go)^3, that of a Griffith law is zero. Instead of the tangent -dY/dz each pair
// therefore uses the secant
//   c = (Y(z) - q) / (z* - z)
// between z and the z* that the pointwise law would choose at the present load q = Y + kappa (A z)/w. The secant tends
// to the tangent at the solution, solves an uncoupled pair in one step, and vanishes only at the solution.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "evolution/increment/gradient.hpp"
#include "law/law.hpp"

namespace delam {

struct CoupledDamage {
    std::vector<double> adhesion;  // [pairs of the interface]
    std::int64_t iterations = 0;   // factorisations
    // The largest amount by which a single pair would still move along the projected gradient; a pure number.
    double residual = 0.0;
    bool converged = false;
};

// All arrays over the interface's pairs. driving: Y. lower, adhesion_old: the bounds. pointwise: the minimiser without
// the gradient term, which uncoupled pairs keep. start: an earlier solution nearby.
CoupledDamage coupled_damage(const GradientTerm& term, const Law& law, std::span<const Toughness> toughness,
                             std::span<const double> driving, std::span<const double> lower,
                             std::span<const double> adhesion_old, std::span<const double> pointwise,
                             std::span<const double> start);

}  // namespace delam
