// SPDX-License-Identifier: BSD-3-Clause
// Chooses the step control of an analysis, and how fine its parts are.
#pragma once

#include <string>

#include "scene/options.hpp"
#include "scene/problem.hpp"

namespace delam {

// The step control of an analysis.
struct StepControl {
    std::string name;    // load, adaptive or fixed
    std::string reason;  // in words
    double path_step;    // the option or, where it has its default, what follows from the option accuracy
    double located;      // share of a step to which its jumps are located where it is taken whole; 0: not at all
};
// Returns `load` for the option `auto` where the other options leave a path to follow, the library solves the bodies,
// and nothing needs whole steps. given: the options of the problem as the host gave them; whole: what needs whole
// steps; empty: nothing.
StepControl used_step_control(const Problem& problem, const Options& given, const std::string& whole = {});
// True if an option asks for steps in parts that are refused and halved.
bool controls_steps(const Options& options);
// Error(DELAM_ERROR_PROBLEM): step_control = load, and no path to follow.
void check_step_control(const Problem& problem);

}  // namespace delam
