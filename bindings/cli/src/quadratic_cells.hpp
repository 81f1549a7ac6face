// SPDX-License-Identifier: BSD-3-Clause
// From cells with straight sides to quadratic ones whose sides follow the interfaces.
#pragma once

#include <functional>

#include "mesh_data.hpp"

namespace cli {

// Moves the middle of an edge that lies between bodies onto their interface. bodies: labels, ascending, at least two;
// middle: [dimension], halfway on entry.
using Bend = std::function<void(const std::vector<std::int32_t>& bodies, double* middle)>;

// tri3, quad4 and tet4 become tri6, quad8 and tet10; sets of faces get their middle nodes, as do the node sets of the
// same name. Where bent sides would squeeze a cell (its smallest Jacobian below a fifth of that with straight sides),
// they are bent half, a quarter or not at all, and so are their periodic images. Returns how many sides that are.
std::int64_t make_quadratic(MeshData& mesh, const Bend& bend);

}  // namespace cli
