// SPDX-License-Identifier: BSD-3-Clause
// The neighbour of a body that touches none.
#pragma once

#include <cstdint>
#include <limits>

#include "mesh/mesh_data.hpp"

namespace cli {

struct NearBody {
    std::int32_t body = -1;  // -1: there is no other
    double distance = std::numeric_limits<double>::infinity();
};
// Returns the body that has the node nearest to a node of this body.
NearBody nearest_body(const MeshData& mesh, std::int32_t body);

}  // namespace cli
