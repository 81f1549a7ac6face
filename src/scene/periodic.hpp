// SPDX-License-Identifier: BSD-3-Clause
// Partners on the faces of a periodic cell: nodes that a sum of periods carries onto a node of the cell's lower faces.
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

// The cell is a parallelepiped along its periods (where there are fewer than dimensions: with any extent across them).
// periods: [count][dimension], independent. tolerance: largest distance of partners, as a fraction of the cells'
// largest extent. Where several nodes lie at one place (faces that touch), partners are of the same body; what is then
// left over on both sides, one node each, makes a pair too. One pair for each node that is not on lower faces alone:
// edges and corners get no redundant ones. Throws Error(DELAM_ERROR_MESH) naming nodes without partner, or the
// direction in which the mesh is not one period long.
std::vector<PeriodicPair> periodic_pairs(const Mesh& mesh, std::span<const double> periods, double tolerance);

}  // namespace delam
