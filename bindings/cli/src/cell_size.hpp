// SPDX-License-Identifier: BSD-3-Clause
// Which edge of a cell divides several lengths at once.
#pragma once

#include <string>
#include <vector>

namespace cli {

// A readable number near h that divides all lengths evenly; "" when there is none worth naming.
std::string suggested_size(const std::vector<double>& lengths, double h);
bool divides(double h, double length);

}  // namespace cli
