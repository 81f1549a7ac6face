// SPDX-License-Identifier: BSD-3-Clause
// The options of the commands that tell about the program: options, schema, man, completion.
#pragma once

#include "command/line/arguments.hpp"

namespace cli {

void add_help(CLI::App& app, Arguments& into, Commands& of);

}  // namespace cli
