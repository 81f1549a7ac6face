// SPDX-License-Identifier: BSD-3-Clause
// Completion of the command line in shells.
#pragma once

#include <string>
#include <vector>

#include "command/help/command_text.hpp"

namespace cli {

const std::vector<std::string>& completion_shells();
// The script of a shell among completion_shells().
std::string completion(const ProgramText& program, const std::string& shell);

}  // namespace cli
