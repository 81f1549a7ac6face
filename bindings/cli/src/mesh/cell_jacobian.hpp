// SPDX-License-Identifier: BSD-3-Clause
// The map from a reference cell to a cell: where it turns over, and what it measures. Simplices and quadrilaterals.
#pragma once

#include <cstdint>

namespace cli {

// x: [nodes of the type][dimension]. Smallest determinant of dx/dxi at the corners, the middle nodes, the centroids
// of a tetrahedron's faces, and the centre; > 0 where the cell is sound.
double smallest_jacobian(std::int32_t type, const double* x);

// Area or volume, curved sides included.
double cell_measure(std::int32_t type, const double* x);

}  // namespace cli
