// SPDX-License-Identifier: BSD-3-Clause
// Makes the mesh of a scene from the parts, sets and surfaces of an Abaqus input file.
#pragma once

#include <string>
#include <vector>

#include "deck/abaqus/abaqus_model.hpp"
#include "mesh/mesh_data.hpp"

namespace cli::abaqus {

// bodies: as in read_abaqus.hpp, named at `place`. Nodes have the numbers of Part::first_node, which is set here.
// made: if it is there, the element of which each cell was made, block after block.
MeshData mesh_of(Model& model, const std::vector<std::string>& bodies, const Place& place,
                 std::vector<ElementAt>* made = nullptr);

}  // namespace cli::abaqus
