// SPDX-License-Identifier: BSD-3-Clause
// Tells which scenes large rotations do not know.
#pragma once

#include <string>

#include "scene/problem.hpp"

namespace delam {

// Returns what the scene or another option has that large rotations do not know, and what to do; empty: nothing.
std::string unknown_to_rotations(const Problem& problem);
// Error(DELAM_ERROR_PROBLEM): kinematics = corotational, and the scene or another option has what that does not know.
void check_kinematics(const Problem& problem);

}  // namespace delam
