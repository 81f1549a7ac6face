// SPDX-License-Identifier: BSD-3-Clause
// The command line: reads it, calls the subcommand, and turns what goes wrong into words and an exit code.
#pragma once

#include "command/commands.hpp"

namespace cli {

int program(int argc, char** argv, const Caller& caller);

}  // namespace cli
