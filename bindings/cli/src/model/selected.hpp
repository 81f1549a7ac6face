// SPDX-License-Identifier: BSD-3-Clause
// Nodes of the mesh that a place in the scene stands for.
#pragma once

#include <cstdint>
#include <vector>

namespace cli {

struct Selected {
    std::vector<std::int64_t> nodes;
    std::vector<double> weights;  // of a patch or of faces; empty otherwise
    std::vector<double> at;       // of a point: where its node is
    std::vector<double> normals;  // of faces: [nodes][dimension] integrals of shape function times outward normal
};

}  // namespace cli
