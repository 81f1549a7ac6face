// SPDX-License-Identifier: BSD-3-Clause
// Generator of a block of stacked layers, each a separate body (delam_mesh_create_layers).
#pragma once

#include <span>

#include "mesh/mesh.hpp"

namespace delam {

Mesh make_layers(int dimension, std::span<const double> lengths, std::span<const std::int64_t> divisions,
                 std::span<const double> thickness, std::span<const std::int64_t> layer_divisions, CellType type);

}  // namespace delam
