// SPDX-License-Identifier: BSD-3-Clause
// Faces of two bodies that lie on each other without matching node by node.
#pragma once

#include <span>
#include <utility>

#include "mesh/faces.hpp"
#include "mesh/mesh.hpp"

namespace delam {

// The first of `faces_b` that partly covers, within a distance, one of `faces_a` and faces the opposite way; as
// positions in the two lists, or -1, -1.
std::pair<std::int64_t, std::int64_t> find_overlap(const Mesh& mesh, std::span<const BoundaryFace> faces_a,
                                                   std::span<const BoundaryFace> faces_b, double distance);

}  // namespace delam
