// SPDX-License-Identifier: BSD-3-Clause
// Which solution concept a result has, in the words of the library's options: solution = local, mixity_rule = frozen,
// ... Part of every file of a result, since the numbers mean little without it.
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "delam/delam.h"

namespace cli {

using Concept = std::vector<std::pair<std::string, std::string>>;  // option, value

// The options that decide which solution is computed, as the solver took them; `solution` and `mixity_rule` come first.
Concept concept_of(const delam_solver* solver);
// "solution = local, mixity_rule = frozen, ..."
std::string concept_text(const Concept& named);

// Every option of the library as the solver took it.
std::vector<std::pair<std::string, std::variant<double, std::string>>> options_of(const delam_solver* solver);

}  // namespace cli
