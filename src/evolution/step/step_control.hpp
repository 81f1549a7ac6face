// SPDX-License-Identifier: BSD-3-Clause
// A load step in parts: steps that are too long are refused and halved, and bisection locates the instants at which the
// state jumps.
//
// The change over an interval is continuous if its end state differs from its start by less than a jump, or if half of
// the change happens in half of the time twice in a row. Otherwise the interval is halved until it is shorter than the
// tolerance and half of it contains nearly all of the change: then the state jumps within it. An energetic jump happens
// where the energies of two states cross; a local one where the state loses its stability.
#pragma once

#include <cstdint>
#include <vector>

#include "evolution/step/jump_event.hpp"
#include "evolution/step/stepper.hpp"

namespace delam {

struct ControlledStep {
    Stepper::Result result;  // ledger and counts of the whole step
    std::vector<JumpEvent> jumps;
    std::vector<StepPart> parts;  // that lead to the result
};

// True if a step holds a jump, or hides one (jump_event.hpp).
bool may_jump(const PairLaws& pairs, const PairGraph& graph, const State& before, const State& after);
// whole: the step in one part, already computed from `before`. located: share of the step to which bisection locates a
// jump (jump_event.hpp) where no option asks for more; 0: none.
ControlledStep controlled_step(Stepper& stepper, const PairGraph& graph, const State& before, Stepper::Result whole,
                               const Options& options, double located);

}  // namespace delam
