// SPDX-License-Identifier: BSD-3-Clause
// The state with which a stage of an analysis begins (scene/stage.hpp).
//
// Where supports begin or end, nothing moves: those that begin find the displacements that are there, and those that
// end leave their forces. So the displacements, the damage and the stored energy are those of the state before, and
// only the reactions are others. A force that a support leaves brings its potential, -f.u, with it. The recorded work
// takes this up, as if the force had been a dead load from the beginning: once it has fallen to zero, the work is that
// of the reactions and of the force on the way back.
#pragma once

#include <span>

#include "evolution/step/stepper.hpp"

namespace delam {

// stepper: of the scene of the stage. displacement: of the state before, [mesh DOFs]. rotated, rotates: rotations are
// large in the stage before, and in this one.
Stepper::Result take_over(Stepper& stepper, const State& before, std::span<const double> displacement, bool rotated,
                          bool rotates);

}  // namespace delam
