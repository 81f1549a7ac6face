// SPDX-License-Identifier: BSD-3-Clause
// Compares numbers bit for bit.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

namespace delam {

// True if both have the same length and the same bits; zeros of different signs differ, equal NaN do not.
inline bool same_bits(std::span<const double> a, std::span<const double> b) {
    return std::ranges::equal(a, b, {}, std::bit_cast<std::uint64_t, double>, std::bit_cast<std::uint64_t, double>);
}

inline bool same_bits(double a, double b) { return same_bits(std::span(&a, 1), std::span(&b, 1)); }

}  // namespace delam
