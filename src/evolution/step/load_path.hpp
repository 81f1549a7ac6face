// SPDX-License-Identifier: BSD-3-Clause
// A load step followed along its load: the step is cut into parts, each a minimisation at its own load, so that a part
// dissipates little of the toughness of a front, unless the state jumps. With a = sum w g/Gc the area that has been
// dissipated and M the size of the load (in the norm of the energy at fixed damage):
//
//   - a part without damage reaches to the load at which the first pair meets its threshold, which is known: at fixed
//     damage jumps are affine in the load
//   - a part of one mode may dissipate any area at about the rate da/dlnM of the part before, since what it dissipates
//     does not depend on the path; a part of mixed mode `share` of the pairs on its front
//   - a part is flat if its advance needs hardly more load,  dlnM <= eps da/A, with the area A of the interface: shorter
//     parts would not tell more. The load moves first, and then the state jumps.
//
// Flat parts, and their neighbours as long as the whole is flat, are an event: a jump if it extends over more than 2.5
// pairs of each front, else pairs that pop, because the mesh does not resolve the process zone.
#pragma once

#include "evolution/step/step_control.hpp"

namespace delam {

// True if steps are followed in this way.
bool follows_load(const Options& options);
ControlledStep followed_step(Stepper& stepper, const PairGraph& graph, const State& before, double time,
                             const Options& options);

}  // namespace delam
