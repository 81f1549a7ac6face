// SPDX-License-Identifier: BSD-3-Clause
// From a place in the scene to nodes of the mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "handles.hpp"
#include "scene.hpp"

namespace cli {

struct Selected {
    std::vector<std::int64_t> nodes;
    std::vector<double> weights;  // of a patch or of faces; empty otherwise
    std::vector<double> normals;  // of faces: [nodes][dimension] integrals of shape function times outward normal
};

// Throws SceneFailure when nothing is there: of a point it names the nearest node.
// faces: of a set its faces with their weights are asked for, not its nodes.
Selected select(const delam_context* context, const delam_mesh* mesh, const Scene& scene, const Selection& selection,
                bool faces = false);

// Node of a control node.
std::int64_t control_node(const delam_context* context, const delam_mesh* mesh, const Scene& scene, std::size_t index,
                          const Place& place);

}  // namespace cli
