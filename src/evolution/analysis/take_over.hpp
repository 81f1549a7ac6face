// SPDX-License-Identifier: BSD-3-Clause
// The state with which a stage of an analysis begins (scene/stage.hpp).
//
// Where supports begin or end, nothing moves: those that begin find the displacements that are there, and those that
// end leave their forces. So the displacements, the damage and the stored energy are those of the state before, and
// only the reactions are others. The potential of forces that supports leave has a zero of its own, from which its
// energy counts.
#pragma once

#include <span>

#include "evolution/step/stepper.hpp"

namespace delam {

// stepper: of the scene of the stage. displacement: of the state before, [mesh DOFs].
Stepper::Result take_over(Stepper& stepper, const State& before, std::span<const double> displacement);

}  // namespace delam
