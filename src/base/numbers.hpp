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

// e such that 2^-e takes the size >= 0 into [1/2, 1); 0 if it is 0 or not finite.
inline int exponent(double size) {
    int e = 0;
    if (std::isfinite(size)) (void)std::frexp(size, &e);
    return e;
}

// Multiplies by 2^e, without rounding as long as the results are normal numbers.
inline void scale_by_power(std::span<double> values, int e) {
    if (e == 0) return;
    for (double& v : values) v = std::ldexp(v, e);
}

}  // namespace delam
