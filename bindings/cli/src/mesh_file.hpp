// SPDX-License-Identifier: BSD-3-Clause
// Meshes from files.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "error.hpp"
#include "mesh_data.hpp"

namespace cli {

struct MeshFile {
    MeshData mesh;
    std::string hash;  // of the bytes of the file and of its includes
};

// Chosen by the file name's extension: .msh of Gmsh (read_gmsh.hpp), .inp of Abaqus (read_abaqus.hpp); `bodies` is for
// the latter. Nodes without cells that belong to no set are dropped. Throws SceneFailure at `place`, one line that
// begins with the path.
MeshFile read_mesh(const std::string& path, const std::vector<std::string>& bodies, const Place& place);

// Of all files of a mesh together. Throws SceneFailure at `place`, which names the last of them.
constexpr std::int64_t most_mesh_bytes = std::int64_t{1} << 30;
void require_mesh_size(const std::string& path, std::int64_t bytes, const Place& place);

// From corner to corner, along the sides of cells.
double shortest_edge(const MeshData& mesh);

// Drops nodes that belong to no cell and no set; reverses clockwise plane cells and notes how many.
void tidy(MeshData& mesh);

}  // namespace cli
