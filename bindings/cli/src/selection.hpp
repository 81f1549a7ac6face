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
    std::vector<double> weights;  // of a patch; empty otherwise
};

// Throws SceneFailure when nothing is there: of a point it names the nearest node.
Selected select(const delam_context* context, const delam_mesh* mesh, const Scene& scene, const Selection& selection);

}  // namespace cli
