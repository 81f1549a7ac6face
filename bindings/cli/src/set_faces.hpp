// SPDX-License-Identifier: BSD-3-Clause
// Sets of faces: where tractions act.
#pragma once

#include "selection.hpp"

namespace cli {

// Nodes of a set's faces with int N_i dA and int N_i n dA over them, n the normal out of the body. The faces are those
// of the face set, else the sides of cells all of whose corners are in the node set; of selection.body alone, if that
// is given. Between two bodies a face is one's or the other's, so the body must be named. A single node without
// any face comes without weights. Throws SceneFailure.
Selected select_faces(const delam_context* context, const delam_mesh* mesh, const Scene& scene,
                      const Selection& selection, const std::string& name);

}  // namespace cli
