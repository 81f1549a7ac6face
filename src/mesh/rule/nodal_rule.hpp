// SPDX-License-Identifier: BSD-3-Clause
// Quadrature of a face with its nodes as points and positive weights only.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "mesh/mesh.hpp"

namespace delam {

struct NodalRule {
    std::array<double, most_face_nodes> weight{};  // L (2D) or L2 (3D), > 0
    // The normal at each node times the area that the node represents.
    std::array<std::array<double, 3>, most_face_nodes> area{};
};

// nodes: of a face, corners then mid-sides. Weights sum to the length of an edge, curved or not, and to the area of a
// face; that of a curved face is the area of its linear pieces (face_pieces).
NodalRule nodal_rule(const Mesh& mesh, std::span<const std::int64_t> nodes);

// The integrals of the shape functions, exact where the map from the reference cell is affine, and those of shape
// function times normal, exact on curved faces too: 6-node triangles have no positive weights at corners, 8-node faces
// negative ones.
NodalRule shape_integrals(const Mesh& mesh, std::span<const std::int64_t> nodes);

}  // namespace delam
