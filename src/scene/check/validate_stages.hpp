// SPDX-License-Identifier: BSD-3-Clause
// Checks the scene of every stage of an analysis (scene/stage.hpp).
#pragma once

#include "base/monitor.hpp"
#include "scene/problem.hpp"

namespace delam {

// Throws Error(DELAM_ERROR_PROBLEM) as validate() does, for the stages from the one at a time on. The message of a
// later one begins with its time.
void validate_stages(const Problem& problem, double time, const Poll& poll = {});

}  // namespace delam
