// SPDX-License-Identifier: BSD-3-Clause
// Means over the faces of one side for the nodes of the other (dual mortar method).
#pragma once

#include <cstdint>
#include <map>

#include "mesh/pairing/unmatched_faces.hpp"

namespace delam {

// Returns the tie of each node of faces.on(). Throws Error(DELAM_ERROR_MESH) where a face lies on the ground in part.
std::map<std::int64_t, Tie> mortar_ties(const Mesh& mesh, const UnmatchedFaces& faces);

}  // namespace delam
