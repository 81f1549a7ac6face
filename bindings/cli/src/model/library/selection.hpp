// SPDX-License-Identifier: BSD-3-Clause
// Finds the nodes of the mesh for a place in the scene.
#pragma once

#include <cstdint>
#include <vector>

#include "delam/delam.h"
#include "model/library/set_faces.hpp"
#include "scene/scene.hpp"

namespace cli {

// Throws SceneFailure if nothing is there; for a point the message names the nearest node.
// faces: use the faces of a set with their weights, not its nodes.
Selected select(const delam_context* context, const delam_mesh* mesh, const Scene& scene, const Selection& selection,
                bool faces = false);

// The mesh node of a control node.
std::int64_t control_node(const delam_context* context, const delam_mesh* mesh, const Scene& scene, std::size_t index,
                          const Place& place);

}  // namespace cli
