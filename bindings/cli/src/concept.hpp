// SPDX-License-Identifier: BSD-3-Clause
// Which solution concept a result has, in the words of the library's options: solution = local, mixity_rule = frozen, ...
// Part of every file of a result, since the numbers mean little without it.
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "scene.hpp"

namespace cli {

using OptionValue = std::pair<std::string, std::variant<double, std::string>>;

// Every option of the library with the value that is used: the scene's, else the default.
std::vector<OptionValue> options_used(const Scene& scene);
// Those that decide which solution is computed, as texts, `solution` and `mixity_rule` first; of the library's options.
std::vector<std::pair<std::string, std::string>> concept_of(const Scene& scene);

}  // namespace cli
