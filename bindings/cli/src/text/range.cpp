// SPDX-License-Identifier: BSD-3-Clause
#include "text/range.hpp"

#include <cmath>
#include <limits>

namespace cli {

namespace {
constexpr double infinite = std::numeric_limits<double>::infinity();
}  // namespace

const Range any_number{-infinite, infinite, true, true, "(finite)"};
const Range positive{0, infinite, true, true, "> 0 (finite)"};
const Range not_negative{0, infinite, false, true, ">= 0 (finite)"};
const Range fraction{0, 1, false, false, "in [0, 1]"};
const Range poisson_range{-1, 0.5, true, true, "in (-1, 0.5)"};
const Range pairing_tolerance{0, 0.5, false, true, "in [0, 0.5)"};

bool Range::contains(double value) const {
    if (!std::isfinite(value)) return false;
    return (lower_open ? value > lower : value >= lower) && (upper_open ? value < upper : value <= upper);
}

}  // namespace cli
