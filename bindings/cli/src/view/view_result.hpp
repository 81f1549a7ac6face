// SPDX-License-Identifier: BSD-3-Clause
// result.json and the tables of a result, as far as `delam view` shows them. Everything that reaches the page is
// checked: every failure is a Failure(exit_scene) that names the file, the place in it and the value.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace cli {

// The largest number of a page, whose arrays are of 4 bytes.
inline constexpr double largest_shown = 3.4e38;

struct ViewAbout {
    nlohmann::json shown;  // data of the solution for the page
    std::int32_t dimension = 0;
    double shortest_edge = 0;
    std::string scene_hash;
    std::vector<std::string> bodies;  // their names
    std::vector<std::string> fields;  // those that the scene asked for
    std::int64_t steps_done = 0;
    std::vector<std::string> patterns;
};
ViewAbout view_about(const std::string& folder);

struct ViewHistory {
    nlohmann::json columns;
    std::vector<double> times;  // by step
};
ViewHistory view_history(const std::string& folder, const ViewAbout& about);

nlohmann::json view_jumps(const std::string& folder, const ViewAbout& about, const ViewHistory& history);

}  // namespace cli
