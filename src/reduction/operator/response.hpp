// SPDX-License-Identifier: BSD-3-Clause
// Arguments and results of a jump operator.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "reduction/operator/zone.hpp"

namespace delam {

// The present state of the interface rows.
struct Springs {
    std::vector<double> stiffness;  // [rows] s = weight k zeta >= 0, F/L; 0: debonded (no force)
    std::vector<std::uint8_t>
        held;  // [rows] 1: jump held at zero (perfect bond, closed contact); stiffness is then ignored
    std::vector<double>
        force{};  // [rows] h, F: the spring pulls with s j - h; only where s > 0 or the row is held. Empty: none
};

// The support whose equation B_d u = c a response misses most.
struct SupportError {
    std::int64_t constraint = -1;  // -1: none misses
    double error = 0.0;            // |B_d u - c|, L
    double size = 0.0;             // of the displacements of which this is a difference, L
    // Allowed error, relative to the displacements: far above the error of a converged solve (1e-12), far below what
    // anybody would call held. A host that asks for fewer digits of the iterative solve has asked for them at its
    // supports, too.
    static double allowed(double linear_tolerance) { return std::max(1e-6, linear_tolerance); }
    bool violated(double linear_tolerance) const { return !(error <= allowed(linear_tolerance) * size); }
};

struct Response {
    std::vector<double> jump;         // [rows] L
    std::vector<double> force;        // [rows] force of a pair, F, pulling positive
    std::vector<double> conjugate;    // [patterns] q = dE/dtheta
    std::vector<double> multipliers;  // the operator's own unknowns: warm start in, solution out (empty: cold)
    std::vector<double> rigid;        // the operator's rigid-body coefficients of the solution
    double stored_bulk = 0.0;         // 1/2 int (eps - e*) : C : (eps - e*) >= 0 with the eigenstrains e*(theta)
    double load_potential = 0.0;      // -f^T u of the dead forces in f
    double residual = 0.0;            // relative residual of the linear solve (energy norm)
    std::int64_t iterations = 0;      // Krylov iterations of this solve
    SolveError error;                 // that the residual allows
    SupportError support;             // none where the realisation meets the supports by construction
    bool balanced = true;             // false: a floating part carries an unbalanced load; the rest is then not set
    bool converged = true;
};

// Accuracy of an iterative solve: enough for a first idea of contact, as the option linear_tolerance says, or all that
// this operator can reach.
enum class Accuracy { rough, usual, tight };

}  // namespace delam
