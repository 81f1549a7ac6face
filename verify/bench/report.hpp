// SPDX-License-Identifier: BSD-3-Clause
// Aligned text for people.
#pragma once

#include <string>
#include <vector>

namespace bench {

using Row = std::vector<std::string>;
void print_rows(const Row& head, const std::vector<Row>& rows);
std::string number(double value, const char* format = "%.3g");  // "-" for NaN

}  // namespace bench
