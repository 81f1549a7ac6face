// SPDX-License-Identifier: BSD-3-Clause
// Meshes from files.
#pragma once

#include <string>
#include <vector>

#include "error.hpp"
#include "mesh_data.hpp"

namespace cli {

struct MeshFile {
    MeshData mesh;
    std::string hash;  // of the bytes of the file and of what it includes
};

// By the ending of the name: .msh of Gmsh (read_gmsh.hpp), .inp of Abaqus (read_abaqus.hpp); `bodies` for the latter.
// Nodes without cells that no set names are gone. Throws SceneFailure at `place`, one line that begins with the path.
MeshFile read_mesh(const std::string& path, const std::vector<std::string>& bodies, const Place& place);

// Drops nodes that no cell and no set has; turns plane cells that run clockwise round and notes how many.
void tidy(MeshData& mesh);

}  // namespace cli
