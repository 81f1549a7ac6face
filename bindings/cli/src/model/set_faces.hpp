// SPDX-License-Identifier: BSD-3-Clause
// Sets of faces, on which tractions act.
#pragma once

#include "delam/delam.h"
#include "model/selected.hpp"
#include "scene/scene.hpp"

namespace cli {

// Nodes of a set's faces with int N_i dA and int N_i n dA over them, n the normal out of the body. The faces are those
// of the face set; for a node set, the sides of cells with all corners in the set; only those of selection.body if it
// is given. A face between two bodies could belong to either, so the body must be named. A single node without any face
// has no weights. Throws SceneFailure.
Selected select_faces(const delam_context* context, const delam_mesh* mesh, const Scene& scene,
                      const Selection& selection, const std::string& name);

}  // namespace cli
