// SPDX-License-Identifier: BSD-3-Clause
// Acceptance of a state outside the solver: the primal KKT conditions in physical units, from exported fields alone.
#pragma once

#include <string>

#include "exported.hpp"

namespace reference {

// Worst violations, each relative to what the condition is measured by; 0 = none.
struct Acceptance {
    double gap = 0.0;               // penetration of the exported jump, over the largest jump
    double gap_displacement = 0.0;  // the same from u_b - u_a, less the rounding of the displacements themselves
    double jump_mismatch = 0.0;     // exported jump against u_b - u_a, likewise
    double pressure = 0.0;          // pull at a closed pair, over the largest traction
    double complementarity = 0.0;   // |gap * contact force|, over largest jump * largest force
    double equilibrium = 0.0;       // K u - loads - supports - tractions, over the largest reaction
    double supports = 0.0;          // prescribed values, over the largest displacement
    double law = 0.0;               // t - zeta k [u] of open components, over the largest traction
    double adhesion = 0.0;          // adhesion outside [0,1]
    // Not part of worst(): equilibrium less what rounding of the displacements can leave, some ulps of |K| |u|.
    double balance = 0.0;

    double worst() const;
    std::string text() const;
};

// A state as fields, of whatever has made it.
struct Fields {
    double time = 0.0;
    std::vector<double> displacement, jump, traction, adhesion, reaction;
    std::vector<bool> contact;
};
// What violations are measured by is at least this: a state without stress has no size of its own.
struct Least {
    double jump = 0.0, traction = 0.0, force = 0.0;
    double between_displacements = 0.0;  // jumps that are u_b - u_a
    double ulps = 8.0;                   // of |K| |u| that the balance leaves out
};
Acceptance accept(const Scene& scene, const Fields& fields, const Exported& exported, const Least& least = {});

// The pending, else the committed state of the solver; `exported` belongs to the solver's scene.
Acceptance accept(const Solver& solver, const Exported& exported);

}  // namespace reference
