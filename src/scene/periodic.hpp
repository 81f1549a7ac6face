// SPDX-License-Identifier: BSD-3-Clause
// Partners on the faces of a periodic cell: nodes that a sum of periods maps to a node of the cell's lower faces.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.hpp"

namespace delam {

struct PeriodicPair {
    std::int64_t node;
    std::int64_t base;  // on the lower faces: x_node = x_base + sum of the periods in `directions`
    std::vector<std::size_t> directions;
};

// The cell is a parallelepiped along its periods; with fewer periods than dimensions it has any extent in the other
// directions. periods: [count][dimension], independent. tolerance: largest distance of partners, as a fraction of the
// cells' largest extent. If several nodes lie at one position (faces that touch), partners belong to the same body;
// nodes left over on both sides, one each, form a pair too. There is one pair for each node that is not only on lower
// faces, so edges and corners get no redundant pairs. Throws Error(DELAM_ERROR_MESH) naming nodes without a partner, or
// the direction in which the mesh is not one period long.
std::vector<PeriodicPair> periodic_pairs(const Mesh& mesh, std::span<const double> periods, double tolerance);

}  // namespace delam
