// SPDX-License-Identifier: BSD-3-Clause
// The mode in which stresses soften bodies most: the largest factor of  G v = factor K v,  with the stiffness K without
// stresses and G, by which they soften it. Above 1 the stiffness K - G under stresses is not positive definite, and the
// bodies buckle along v; stresses in proportion are critical at 1 / factor of the present ones.
//
// Lanczos' method in the inner product of K, with all vectors orthogonal to each other (B. Parlett, The Symmetric
// Eigenvalue Problem, 1998, sections 13.1 and 15.11).
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace delam {

struct BucklingMode {
    double factor = 0.0;
    std::vector<double> displacement;  // its largest magnitude is 1, its sign that of orient()
    std::int64_t solves = 0;
    bool converged = false;  // to the accuracy
};

// solve: K^-1 f; soften: G v. Both are symmetric and take and return as many numbers. No number is random: the first
// force has a part in every mode, whatever the numbering.
using Apply = std::function<std::vector<double>(std::span<const double>)>;
// tolerance: of the residual K^-1 G v - factor v over factor v, both in the energy of K; the error of the factor is its
// square, times the factor. (The step of examples/blister that buckles takes 14, 16 and 18 solves with 1e-3, 1e-6 and
// 1e-9; critical loads agree to 3e-7, the states that follow to 1e-10.) least: of smaller factors the residual is
// within this tolerance of it.
struct ModeAccuracy {
    double tolerance = 1e-6;
    double least = 0.0;
};
BucklingMode buckling_mode(std::size_t size, const Apply& solve, const Apply& soften, const ModeAccuracy& = {});

// Changes the sign of a mode so that its first component of at least half of the largest magnitude is positive: no
// rounding decides it where two of its waves are equal.
void orient(std::span<double> mode);

}  // namespace delam
