// SPDX-License-Identifier: BSD-3-Clause
// Follows the load of a step within a scene that stays linear about its end (linearised_scene.hpp): what pairs of mixed
// mode dissipate depends on the loads at which they break. The scene at the begin of the step differs from the state
// before by the square of what the step turns, and so do the parts of the step from those with large rotations. Its
// ends are those of the true scene.
#pragma once

#include "evolution/search/fronts.hpp"
#include "evolution/step/stepper.hpp"
#include "scene/options.hpp"

namespace delam {

// Tells of the path between the ends of a step, F L.
struct PathWithin {
    double beyond = 0.0;    // work of the reactions, less that of the trapezoidal rule between the ends
    double released = 0.0;  // by pairs that pop, or jump
};

// Returns a step of the linear scene, along its load, from a state to a later time; from a state at this time, whole.
Stepper::Result follow_within(Stepper& stepper, const PairGraph& graph, const State& from, double time,
                              const Options& options, PathWithin& within);

}  // namespace delam
