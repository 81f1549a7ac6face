// SPDX-License-Identifier: BSD-3-Clause
// A load step followed along its load: the step is cut into parts, each a minimisation at its own load. No part may
// dissipate much while the load is the same (path/advance.hpp says how that is measured).
//
//   - Where all loads grow in proportion, the load at which the first pair meets its threshold is known, since jumps at
//     fixed damage grow with it.
//   - What a part of one mode dissipates does not depend on its path. Such a part may advance at the rate da/dlnM of
//     the part before, or by single pairs. Its work does: longer parts than single pairs leave at most `accuracy` open,
//     of what they dissipate themselves or, since their errors have either sign, of all that has been dissipated. If
//     single pairs pop, no part is short enough for that. Short parts then measure what pairs release, and
//     longer ones release the same share of what they dissipate.
//   - A part of mixed mode dissipates `path_step` of its process zone, or half of the pairs on its front.
//   - A part that is flat (growth_events.hpp) advances as far as it does: shorter ones would not tell more. The load
//     moves first, and then the state jumps; what the jump dissipates is integrated along its own parts at that load
//     (path/inner_path.hpp), and what is neither stored nor dissipated is released.
//   - Where the mesh does not resolve the process zone, single pairs pop. A part then takes one of them.
//
// The work of the reactions by the trapezoidal rule, the stored energy and the dissipated one are computed apart from
// each other. The difference that jumps and pops do not release (value defect) is the error of the parts.
#pragma once

#include "evolution/step/step_control.hpp"

namespace delam {

// True if steps are followed in this way (step_control = auto or load).
bool follows_load(const Options& options);
// base: by which energies of the scene are less than those whose growth tells that of the load.
ControlledStep followed_step(Stepper& stepper, const PairGraph& graph, const State& before, double time,
                             const Options& options, double base = 0.0);

}  // namespace delam
