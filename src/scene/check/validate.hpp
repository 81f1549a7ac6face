// SPDX-License-Identifier: BSD-3-Clause
// Checks that a scene is complete and free of contradictions.
#pragma once

#include "base/monitor.hpp"
#include "scene/problem.hpp"

namespace delam {

// Throws Error(DELAM_ERROR_PROBLEM) for the first thing that is missing or contradictory, including supports: every
// part connected through bonded or adhering pairs needs supports that prevent all its rigid motions.
void validate(const Problem& problem, const Poll& poll = {});

}  // namespace delam
