// SPDX-License-Identifier: BSD-3-Clause
// Finds the nodes of the mesh for a place in the scene.
#pragma once

#include <cstdint>
#include <vector>

#include "handles.hpp"
#include "scene.hpp"

namespace cli {

struct Selected {
    std::vector<std::int64_t> nodes;
    std::vector<double> weights;  // of a patch or of faces; empty otherwise
    std::vector<double> at;       // of a point: where its node is
    std::vector<double> normals;  // of faces: [nodes][dimension] integrals of shape function times outward normal
};

// Throws SceneFailure if nothing is there; for a point the message names the nearest node.
// faces: use the faces of a set with their weights, not its nodes.
Selected select(const delam_context* context, const delam_mesh* mesh, const Scene& scene, const Selection& selection,
                bool faces = false);

// The mesh node of a control node.
std::int64_t control_node(const delam_context* context, const delam_mesh* mesh, const Scene& scene, std::size_t index,
                          const Place& place);

}  // namespace cli
