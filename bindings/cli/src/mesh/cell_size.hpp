// SPDX-License-Identifier: BSD-3-Clause
// Finds an edge length of cells that divides several lengths.
#pragma once

#include <string>
#include <vector>

namespace cli {

// Returns a readable number near h that divides all lengths evenly; "" if no such number is worth suggesting.
std::string suggested_size(const std::vector<double>& lengths, double h);
bool divides(double h, double length);

}  // namespace cli
