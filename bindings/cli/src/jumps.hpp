// SPDX-License-Identifier: BSD-3-Clause
// jumps.csv: the located jumps, one row each.
#pragma once

#include <string>

#include "build.hpp"

namespace cli {

// Whether jumps are located at all (option jump_tolerance > 0).
bool locates_jumps(const delam_solver* solver);
// Header and rows up to the present state.
std::string jumps_text(const Model& model, const delam_solver* solver);

}  // namespace cli
