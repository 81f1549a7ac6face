// SPDX-License-Identifier: BSD-3-Clause
// Reads the mesh of a scene from its file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesh/file_element.hpp"
#include "mesh/mesh_file.hpp"

namespace cli {

// Chosen by the file name's extension: .msh of Gmsh (mesh/gmsh/read_gmsh.hpp), .inp of Abaqus
// (deck/abaqus/read_abaqus.hpp); `bodies` is for the latter. Nodes without cells that belong to no set are dropped.
// Throws SceneFailure at `place`, one line that begins with the path.
MeshFile read_mesh(const std::string& path, const std::vector<std::string>& bodies, const Place& place);

// Returns the elements of the file of which these cells of the mesh were made, by reading it again: only what is wrong
// asks for them. Empty: the mesh has no file, or has changed since it was read. cells: numbers, block after block.
std::vector<FileElement> file_elements(const MeshData& mesh, const std::vector<std::int64_t>& cells);

}  // namespace cli
