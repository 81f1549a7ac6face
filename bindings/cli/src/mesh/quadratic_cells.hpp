// SPDX-License-Identifier: BSD-3-Clause
// Turns cells with straight sides into quadratic ones whose sides follow the interfaces.
#pragma once

#include <functional>

#include "mesh/mesh_data.hpp"

namespace cli {

// Moves the midpoint of an edge that lies between bodies onto their interface. bodies: labels, ascending, at least two;
// middle: [dimension], the straight midpoint on entry.
using Bend = std::function<void(const std::vector<std::int32_t>& bodies, double* middle)>;

// tri3, quad4 and tet4 become tri6, quad8 and tet10; face sets and the node sets of the same name receive the middle
// nodes. Where curved sides would distort a cell (its smallest Jacobian below a fifth of that with straight sides),
// they are curved by a half, a quarter or not at all, and so are their periodic images. Returns the number of these
// sides.
std::int64_t make_quadratic(MeshData& mesh, const Bend& bend);

}  // namespace cli
