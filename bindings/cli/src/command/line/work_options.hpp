// SPDX-License-Identifier: BSD-3-Clause
// The options of the commands that read or write a scene or a result: run, check, import, new, view.
#pragma once

#include "command/line/arguments.hpp"

namespace cli {

Commands add_work(CLI::App& app, Arguments& into);
void add_new(CLI::App& app, Arguments& into, Commands& of);
void add_view(CLI::App& app, Arguments& into, Commands& of);

}  // namespace cli
