// SPDX-License-Identifier: BSD-3-Clause
// Sets of faces, on which tractions act.
#pragma once

#include <cstdint>
#include <vector>

#include "delam/delam.h"
#include "scene/scene.hpp"

namespace cli {

// Nodes of the mesh that a place in the scene stands for.
struct Selected {
    std::vector<std::int64_t> nodes;
    std::vector<double> weights;  // of a patch or of faces; empty otherwise
    std::vector<double> at;       // of a point: where its node is
    std::vector<double> normals;  // of faces: [nodes][dimension] integrals of shape function times outward normal
};

// Nodes of a set's faces with int N_i dA and int N_i n dA over them, n the normal out of the body. The faces are those
// of the face set; for a node set, the sides of cells with all corners in the set; only those of selection.body if it
// is given. A face between two bodies could belong to either, so the body must be named. A single node without any face
// has no weights. Throws SceneFailure.
Selected select_faces(const delam_context* context, const delam_mesh* mesh, const Scene& scene,
                      const Selection& selection, const std::string& name);

}  // namespace cli
