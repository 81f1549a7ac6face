// SPDX-License-Identifier: BSD-3-Clause
// What a test expects; an exception fails it (check.hpp).
#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "check.hpp"

namespace cases {

inline void expect(bool condition, const std::string& text) {
    if (!condition) throw std::runtime_error(text);
}

// |value - exact| <= tolerance * scale
inline void expect_near(double value, double exact, double tolerance, double scale, const std::string& what) {
    if (std::abs(value - exact) <= tolerance * scale) return;
    char line[300];
    std::snprintf(line, sizeof line, "%s: %.17g instead of %.17g, off by %.2e of %.3g (allowed %.1e)", what.c_str(),
                  value, exact, std::abs(value - exact) / scale, scale, tolerance);
    throw std::runtime_error(line);
}

// value <= limit, NaN fails
inline void expect_below(double value, double limit, const std::string& what) {
    if (value <= limit) return;
    char line[600];
    std::snprintf(line, sizeof line, "%s: %.3e > %.3e", what.c_str(), value, limit);
    throw std::runtime_error(line);
}

// In the long tier (case/whole_NAME, see verify/CMakeLists.txt) a test runs everything, in the quick tier what finds
// most in little time.
inline bool whole() { return std::getenv("DELAM_WHOLE") != nullptr; }

}  // namespace cases
