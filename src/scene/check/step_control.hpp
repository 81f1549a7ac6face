// SPDX-License-Identifier: BSD-3-Clause
// Chooses the step control of an analysis, and how fine its parts are.
#pragma once

#include <string>

#include "scene/options.hpp"
#include "scene/problem.hpp"

namespace delam {

// Returns `load`, `adaptive` or `fixed`. The option `auto` is `load` where the other options leave a path to follow.
std::string used_step_control(const Options& options);
// Returns the option path_step or, where it has its default, what follows from the option accuracy.
double used_path_step(const Options& options);
// Error(DELAM_ERROR_PROBLEM): step_control = load, and no path to follow.
void check_step_control(const Problem& problem);

}  // namespace delam
