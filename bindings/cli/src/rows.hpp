// SPDX-License-Identifier: BSD-3-Clause
// The numbers of history.csv by column.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

// Row 0 is the initial state. Texts count as 0.
std::vector<std::map<std::string, double>> rows_of(std::string_view history);

}  // namespace cli
