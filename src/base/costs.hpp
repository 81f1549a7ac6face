// SPDX-License-Identifier: BSD-3-Clause
// Costs that several parts of the library compare.
#pragma once

namespace delam {

// A triangular solve waits for memory: its operations take this many times as long as those of a factorisation.
inline constexpr double triangular_slowdown = 20.0;

}  // namespace delam
