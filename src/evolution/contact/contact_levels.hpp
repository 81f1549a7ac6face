// SPDX-License-Identifier: BSD-3-Clause
// Nested coarse sets of pairs for a cold start of the contact search.
//
// An active set first changes by whole regions and then, on a fine interface, by one pair at each end of a region, so
// the number of its steps grows with 1/h. If the search begins among pairs far apart, continues among twice as many,
// and so on, every level starts near its solution.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/interface_geometry.hpp"

namespace delam {

// [pairs] the coarsest level at which a pair takes part: pairs of level >= l lie about 2^l faces apart.
std::vector<std::uint8_t> contact_levels(std::span<const InterfaceGeometry> interfaces);

}  // namespace delam
