// SPDX-License-Identifier: BSD-3-Clause
// The solution concept of a result, as options of the library: solution = local, mixity_rule = frozen, ... It is part
// of every file of a result, because the numbers mean little without it.
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "delam/delam.h"

namespace cli {

using Concept = std::vector<std::pair<std::string, std::string>>;  // option, value

// The options that decide which solution is computed, as the problem has them, or as the solver has chosen them;
// `solution` and `mixity_rule` come first.
Concept concept_of(const delam_problem* problem);
Concept concept_of(const delam_solver* solver);
// "solution = local, mixity_rule = frozen, ..."
std::string concept_text(const Concept& named);

// An option of the library as the solver has it; "" or 0 for a key that the library does not have.
std::string option_text(const delam_solver* solver, const char* key);
double option_number(const delam_solver* solver, const char* key);
// Every option of the library as the solver has it.
std::vector<std::pair<std::string, std::variant<double, std::string>>> options_of(const delam_solver* solver);

}  // namespace cli
