// SPDX-License-Identifier: BSD-3-Clause
// Supports against perfect bonds: whether prescribed displacements leave bonded pairs no choice but to open.
#pragma once

#include "reduction/operator/jump_variables.hpp"
#include "scene/problem.hpp"

namespace delam {

// Throws Error(DELAM_ERROR_PROBLEM) if the equations  j_r = 0  of all bonded rows contradict each other, directly or
// through bodies that are bonded to both sides.
void refuse_open_bonds(const Problem& problem, const JumpVariables& variables);

}  // namespace delam
