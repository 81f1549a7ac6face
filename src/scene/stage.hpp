// SPDX-License-Identifier: BSD-3-Clause
// Supports that begin or end within an analysis cut it into stages, and so do bodies that begin to rotate (kinematics =
// auto). The same equations hold all through a stage.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/problem.hpp"

namespace delam {

// Says where a stage begins, and what it takes over from the state there.
struct Stage {
    double from = 0.0;
    // [constraints] For each equation that has begun, the factor of its pattern on the right-hand side that makes up
    // for what nodes had moved by then, L; otherwise 0.
    std::vector<double> offset;
    // [constraints] For each equation that has ended, its reaction then per unit of the factor of its pattern, F;
    // otherwise 0.
    std::vector<double> force;
    bool rotates = false;  // kinematics = auto: rotations are large in it
    bool operator==(const Stage&) const = default;
};

// True if kinematics = auto, so that a stage may begin with any step.
bool may_turn(const Problem& problem);
// True if equations begin or end after this time.
bool has_stages(const Problem& problem, double after);
// The times at which equations begin or end, ascending, each once.
std::vector<double> changes_of(const Problem& problem);
// The first of these times after `time`; infinity: there is none.
double next_change(const Problem& problem, double time);
// The equations that hold from a time up to the next change, ascending.
std::vector<std::int64_t> constraints_from(const Problem& problem, double time);
// The scene of a stage that takes over nothing.
Problem scene_from(const Problem& problem, double time);
// The scene of a stage: the equations that hold in it, and the forces of those that have ended.
Problem scene_of(const Problem& problem, const Stage& stage);

}  // namespace delam
