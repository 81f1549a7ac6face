// SPDX-License-Identifier: BSD-3-Clause
// The subcommands; each returns an exit code or throws a Failure.
#pragma once

#include <string>
#include <vector>

namespace cli {

// settings: KEY=VALUE, see setting.hpp. command: the line as typed, for result.json.
int run(const std::string& scene_file, const std::vector<std::string>& settings, const std::string& folder, bool resume,
        const std::string& command);
int check(const std::string& scene_file, const std::vector<std::string>& settings);

}  // namespace cli
