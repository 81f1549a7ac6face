// SPDX-License-Identifier: BSD-3-Clause
// Solves with the leading block of a supernodal factor. The rows of the trailing variables in the leading columns, and
// the trailing columns, are as large a part of a factor whose trailing variables are all coupled; they are not read.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "linalg/sparse/single_factor.hpp"

namespace delam {

// y = (L_ll L_ll^T)^-1 y, both in the order of elimination, [leading]. below: memory between calls.
void solve_leading_block(const Supernodes& nodes, const double* values, std::int64_t leading, std::span<double> y,
                         std::vector<double>& below);

}  // namespace delam
