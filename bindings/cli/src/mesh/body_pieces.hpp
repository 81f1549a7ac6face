// SPDX-License-Identifier: BSD-3-Clause
// Bodies of a mesh that consist of several pieces.
#pragma once

#include <cstddef>
#include <vector>

#include "mesh/mesh_data.hpp"

namespace cli {

// Makes a body of each piece, which is what nodes of the file connect: NAME becomes NAME-1, NAME-2, .. in the order of
// the cells, or NAME-piece-1 where another body has such a name. A body of one piece keeps its name.
// Returns the number of pieces of each body before.
std::vector<std::size_t> split_into_pieces(MeshData& mesh);

}  // namespace cli
