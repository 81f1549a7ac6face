// SPDX-License-Identifier: BSD-3-Clause
// The options of the studies: sweep, fit, evaluate, and what these ask of the program.
#pragma once

#include "command/line/arguments.hpp"

namespace cli {

void add_studies(CLI::App& app, Arguments& into, Commands& of);
// Hidden from people: the studies call it.
void add_own(CLI::App& app, Arguments& into, Commands& of);

}  // namespace cli
