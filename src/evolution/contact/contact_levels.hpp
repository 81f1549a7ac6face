// SPDX-License-Identifier: BSD-3-Clause
// Nested coarse sets of pairs for a cold start of the contact search.
//
// An active set first changes by whole regions, then by one pair at each end of a region. The number of its steps
// therefore grows with 1/h. The search begins among pairs that are far apart, and each level has twice as many, so that
// it starts near its solution.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/interface_geometry.hpp"

namespace delam {

// [pairs] the coarsest level at which a pair takes part: pairs of level >= l lie about 2^l faces apart.
std::vector<std::uint8_t> contact_levels(std::span<const InterfaceGeometry> interfaces);

}  // namespace delam
