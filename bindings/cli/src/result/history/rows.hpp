// SPDX-License-Identifier: BSD-3-Clause
// The numbers of history.csv by column.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

using Row = std::map<std::string, double, std::less<>>;
using Rows = std::vector<Row>;

// Row 0 is the initial state. Texts count as 0.
Rows rows_of(std::string_view history);
// 0 if there is no such column: load_potential exists only with dead loads.
double number_of(const Row& row, std::string_view column);
// Returns the scale with which differences of energies are compared: max(|stored energy|, |work|), stored energy with
// load_potential.
double energy_scale(const Row& row);

}  // namespace cli
