// SPDX-License-Identifier: BSD-3-Clause
// Observed orders of convergence.
#pragma once

#include <limits>
#include <vector>

namespace harness {

inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Returns p of the last three values v ~ v0 + c size^p, for any ratio of their sizes, p within 0.05 .. 8. NaN if there
// is no such p (the values oscillate, or are not yet asymptotic).
double order_of_values(const std::vector<double>& sizes, const std::vector<double>& values);
// v0 of the same, from the last two values at a known order.
double richardson(const std::vector<double>& sizes, const std::vector<double>& values, double order);

}  // namespace harness
