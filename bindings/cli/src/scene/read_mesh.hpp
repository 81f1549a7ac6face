// SPDX-License-Identifier: BSD-3-Clause
// Reads the mesh of a scene from its file.
#pragma once

#include <string>
#include <vector>

#include "mesh/mesh_file.hpp"

namespace cli {

// Chosen by the file name's extension: .msh of Gmsh (mesh/gmsh/read_gmsh.hpp), .inp of Abaqus
// (deck/abaqus/read_abaqus.hpp); `bodies` is for the latter. Nodes without cells that belong to no set are dropped.
// Throws SceneFailure at `place`, one line that begins with the path.
MeshFile read_mesh(const std::string& path, const std::vector<std::string>& bodies, const Place& place);

}  // namespace cli
