// SPDX-License-Identifier: BSD-3-Clause
// Small helpers for numbers and arrays.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace delam {

inline constexpr double infinite = std::numeric_limits<double>::infinity();

// Converts a non-negative index or count of the public interface to an array index.
inline constexpr std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); }

// The largest absolute value; 0 if there are no values. Ignores NaN.
inline double max_abs(std::span<const double> values) {
    double largest = 0.0;
    for (const double v : values) largest = std::max(largest, std::abs(v));
    return largest;
}

}  // namespace delam
