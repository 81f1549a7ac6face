// SPDX-License-Identifier: BSD-3-Clause
// Intervals of numbers that a key allows.
#pragma once

#include <string_view>

namespace cli {

// An open or closed interval, with its description in words.
struct Range {
    double lower;
    double upper;
    bool lower_open;
    bool upper_open;
    std::string_view text;

    [[nodiscard]] bool contains(double value) const;
};

extern const Range any_number;
extern const Range positive;
extern const Range not_negative;
extern const Range fraction;           // [0, 1]
extern const Range poisson_range;      // (-1, 0.5)
extern const Range pairing_tolerance;  // [0, 0.5)

}  // namespace cli
