// SPDX-License-Identifier: BSD-3-Clause
// What the page says of a result beside its fields: result.json, history.csv and jumps.csv.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace cli {

// Each as JSON for the page; a Failure(exit_scene) names the file.
// What result.json says; the paths and the command of whoever ran it are left out.
nlohmann::json view_about(const std::string& folder);
// [{"name", "values"}], the columns of numbers in the order of the file.
nlohmann::json view_history(const std::string& folder);
// A row for each jump, a column of jumps.csv by each key; empty where there is no such file.
nlohmann::json view_jumps(const std::string& folder);

}  // namespace cli
