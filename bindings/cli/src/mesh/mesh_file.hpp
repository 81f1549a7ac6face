// SPDX-License-Identifier: BSD-3-Clause
// Meshes from files.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesh/mesh_data.hpp"
#include "text/error.hpp"

namespace cli {

struct MeshFile {
    MeshData mesh;
    std::string hash;  // of the bytes of the file and of its includes
};

// Limit of all files of a mesh together. Throws SceneFailure at `place`, which names the last of them.
constexpr std::int64_t most_mesh_bytes = std::int64_t{1} << 30;
void require_mesh_size(const std::string& path, std::int64_t bytes, const Place& place);

// Returns the shortest distance of neighbouring corners, along the sides of cells. cell: if it is there, the number of
// the first cell that has it, block after block.
double shortest_edge(const MeshData& mesh, std::int64_t* cell = nullptr);

// Drops nodes that belong to no cell and no set; reverses clockwise plane cells and notes how many.
void tidy(MeshData& mesh);

}  // namespace cli
