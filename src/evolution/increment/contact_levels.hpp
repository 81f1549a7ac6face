// SPDX-License-Identifier: BSD-3-Clause
// Nested coarse sets of pairs for a contact search from cold.
//
// An active set changes by whole regions at first and then, on a fine interface, by one pair at each end of a region:
// its steps grow with 1/h. Searched first among pairs far apart, then among twice as many, and so on, every level
// starts near its answer.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/interface_geometry.hpp"

namespace delam {

// [pairs] the coarsest level at which a pair takes part: pairs of level >= l lie about 2^l faces apart.
std::vector<std::uint8_t> contact_levels(std::span<const InterfaceGeometry> interfaces);

}  // namespace delam
