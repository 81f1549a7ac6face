// SPDX-License-Identifier: BSD-3-Clause
// [mesh] with `generator` instead of `file`.
#pragma once

#include "mesh/mesh_data.hpp"
#include "scene/table/reader.hpp"

namespace cli {

// Reads the keys of the generator, refuses all others except `plane`, and generates the mesh.
MeshData read_generator(const Table& table);

}  // namespace cli
