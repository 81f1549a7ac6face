// SPDX-License-Identifier: BSD-3-Clause
// The scalars of a state by key: one table for the history, the tests and every host.
#pragma once

#include <string>
#include <vector>

#include "evolution/solver.hpp"

namespace delam {

// Keys in the order of delam_solver_value, the patterns' load: and reaction: last.
std::vector<std::string> value_names(const Problem& problem);
// Throws Error(DELAM_ERROR_ARGUMENT) for an unknown key.
double value(const Solver& solver, const std::string& key);
// The reason why a value is not recorded; nullptr if it can be.
const char* why_unrecorded(const std::string& key);

}  // namespace delam
