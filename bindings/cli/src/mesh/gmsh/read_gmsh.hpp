// SPDX-License-Identifier: BSD-3-Clause
// Meshes of Gmsh through libgmsh: .msh 2 and 4, ASCII and binary (Gmsh reference manual, "MSH file format").
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "mesh/mesh_file.hpp"

namespace cli {

// Physical groups of the highest dimension are the bodies; if there are none, every entity is one, "surface-1" or
// "volume-1". Groups of lower dimension are node sets, and those of one dimension less are face sets too. Prints
// nothing.
MeshFile read_gmsh(const std::string& path, const Place& place);
// The numbers that the elements have in the file of which its cells are made, block after block.
std::vector<std::size_t> gmsh_elements(const std::string& path, const Place& place);
// The same for the model in the caller's Gmsh session. subject: the start of messages.
MeshData read_gmsh_model(const std::string& subject, const Place& place);

}  // namespace cli
