// SPDX-License-Identifier: BSD-3-Clause
// Checks a state outside the solver: the primal KKT conditions in physical units, from exported fields alone.
#pragma once

#include <string>

#include "exported.hpp"

namespace reference {

// Worst violations, each relative to the scale of its condition; 0 = none.
struct Acceptance {
    double gap = 0.0;               // penetration of the exported jump, over the largest jump
    double gap_displacement = 0.0;  // the same from u_b - u_a, less the rounding of the displacements
    double jump_mismatch = 0.0;     // exported jump against u_b - u_a, less the same rounding
    double pressure = 0.0;          // tension at a closed pair, over the largest traction
    double complementarity = 0.0;   // |gap * contact force|, over largest jump * largest force
    double equilibrium = 0.0;       // K u - loads - supports - tractions, over the largest reaction
    double supports = 0.0;          // prescribed values, over the largest displacement
    double law = 0.0;               // t - zeta k [u] of open components, over the largest traction
    double adhesion = 0.0;          // adhesion outside [0,1]
    // Not part of worst(): equilibrium less the error that rounding of the displacements can cause, some ulps of |K|
    // |u|.
    double balance = 0.0;

    double worst() const;
    std::string text() const;
};

// A state as fields, whoever computed it.
struct Fields {
    double time = 0.0;
    std::vector<double> displacement, jump, traction, adhesion, reaction;
    std::vector<bool> contact;
};
// Lower bounds of the scales: a state without stress has none of its own.
struct Least {
    double jump = 0.0, traction = 0.0, force = 0.0;
    double between_displacements = 0.0;  // for jumps computed as u_b - u_a
    double ulps = 8.0;                   // of |K| |u|, subtracted in the balance
};
Acceptance accept(const Scene& scene, const Fields& fields, const Exported& exported, const Least& least = {});

// The pending state of the solver, or the committed one if none is pending; `exported` belongs to the solver's scene.
Acceptance accept(const Solver& solver, const Exported& exported);

}  // namespace reference
