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
#include <exception>
#include <optional>
#include <vector>

#include "base/error.hpp"
#include "evolution/step/jump_event.hpp"
#include "evolution/step/stepper.hpp"

namespace delam {

struct ControlledStep {
    Stepper::Result result;  // ledger and counts of the whole step
    std::vector<JumpEvent> jumps;
    std::vector<StepPart> parts;  // that lead to the result
};

// A step in one part, as it was tried: its result, or why there is none.
struct TriedStep {
    double time;
    std::optional<Stepper::Result> result;
    std::exception_ptr failure;
};
// True if a shorter step of bodies that rotate may not fail so: cells are turned inside out, or no stable state is
// found.
bool too_long(const Error& error);
// located: share of the step to which bisection locates a jump (jump_event.hpp) where no option asks for more; 0: none.
// cuts: steps that fail so or do not converge are halved, down to the option smallest_step.
struct StepCuts {
    double located;
    bool cuts;
};

// True if a step holds a jump, or hides one (jump_event.hpp).
bool may_jump(const PairLaws& pairs, const PairGraph& graph, const State& before, const State& after);
// whole: the step from `before` in one part. Throws its failure, or that of a part, where no shorter one helps.
ControlledStep controlled_step(Stepper& stepper, const PairGraph& graph, const State& before, TriedStep whole,
                               const Options& options, const StepCuts& cuts);

}  // namespace delam
