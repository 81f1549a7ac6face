// SPDX-License-Identifier: BSD-3-Clause
// Splits cells that are laminates into one cell for each ply.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesh/mesh_data.hpp"
#include "text/error.hpp"

namespace cli {

// The plies of cells, from the side of their first four nodes to the opposite one.
struct Plies {
    std::string name;                 // of the laminate, for people
    std::vector<double> thicknesses;  // all > 0; those of a cell are in proportion to them
    std::vector<double> angles;       // degrees, about axis 3 of the material axes of the cell
    Place place;
};

// of_cell: [cells, block after block] the plies of a hexahedron of 8 nodes, or null. The new nodes stand behind those
// of the mesh, on the straight edges across the plies. A set of nodes has those between two of its nodes; a set of
// faces has the side of each ply. Throws SceneFailure at the place of plies whose edges other cells share without such
// plies.
void split_into_plies(MeshData& mesh, const std::vector<const Plies*>& of_cell);

}  // namespace cli
