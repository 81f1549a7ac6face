// SPDX-License-Identifier: BSD-3-Clause
// Turns what a command throws into words and an exit code.
#pragma once

#include <functional>

namespace cli {

// Returns the exit code of a command; what it throws is said in one line, several refusals in one each.
int reported(const std::function<int()>& command);

}  // namespace cli
