// SPDX-License-Identifier: BSD-3-Clause
// Refuses scenes that large rotations do not know.
#pragma once

#include "scene/problem.hpp"

namespace delam {

// Error(DELAM_ERROR_PROBLEM): kinematics = corotational, and the scene or another option has what that does not know.
void check_kinematics(const Problem& problem);

}  // namespace delam
