// SPDX-License-Identifier: BSD-3-Clause
#include "concept.hpp"

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>

#include "delam/delam.h"

namespace cli {

std::vector<OptionValue> options_used(const Scene& scene) {
    std::vector<OptionValue> out;
    for (std::int64_t i = 0; i < delam_option_count(); ++i) {
        const char* key = "";
        const char* type = "";
        const char* initial = "";
        delam_option_info(i, &key, &type, nullptr, &initial, nullptr, nullptr);
        OptionValue option{key, std::string(initial)};
        if (std::string_view(type) != "text") option.second = std::strtod(initial, nullptr);
        for (const SolverOption& given : scene.options)
            if (given.key == key) option.second = given.value;
        out.push_back(std::move(option));
    }
    return out;
}

std::vector<std::pair<std::string, std::string>> concept_of(const Scene& scene) {
    const std::vector<OptionValue> options = options_used(scene);
    std::vector<std::pair<std::string, std::string>> out;
    for (const char* key : {"solution", "mixity_rule", "backtracking", "backtracking_tolerance", "jump_tolerance",
                            "step_control", "mixity_step_tolerance"}) {
        const auto at = std::find_if(options.begin(), options.end(), [key](const auto& o) { return o.first == key; });
        if (at == options.end()) continue;
        const auto* number = std::get_if<double>(&at->second);
        out.emplace_back(key, number != nullptr ? fmt::format("{:g}", *number) : std::get<std::string>(at->second));
    }
    return out;
}

}  // namespace cli
