// SPDX-License-Identifier: BSD-3-Clause
// The manual pages as roff text: of the program, from its command line, and of scene files, from their tables of keys.
#pragma once

#include <string>

#include "command/help/command_text.hpp"

namespace cli {

std::string man_page_of_program(const ProgramText& program);  // section 1
std::string man_page_of_scenes(const ProgramText& program);   // section 5

}  // namespace cli
