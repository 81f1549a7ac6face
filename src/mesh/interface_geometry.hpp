// SPDX-License-Identifier: BSD-3-Clause
// An interface as node pairs with nodal quadrature weights: the result of matching faces.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

namespace delam {

struct InterfaceGeometry {
    // Body indices; the jump is u_b - u_a. body_a = -1: an obstacle, and all node_a are its control node.
    std::int32_t body_a = -1;
    std::int32_t body_b = -1;
    std::vector<std::int64_t> node_a;  // [pairs] mesh nodes
    std::vector<std::int64_t> node_b;
    std::vector<double> weight;  // [pairs] length (2D) or area (3D) of a pair, > 0
    std::vector<double> frame;   // [pairs][dim][dim] rows: normal from a to b, tangent(s); orthonormal
    int nodes_per_face = 2;
    // [faces][nodes_per_face] pair indices: corners, then mid-sides, then the centre if the cells have one. Triangles
    // among quadrilaterals repeat their last corner, also as the mid-side node of the collapsed side.
    std::vector<std::int64_t> face;

    // Faces farther apart touch only if somebody says so (pair_distances, Problem::gap_rows), L.
    double reach = std::numeric_limits<double>::infinity();

    std::int64_t pair_count() const { return static_cast<std::int64_t>(node_a.size()); }
    std::int64_t face_count() const { return static_cast<std::int64_t>(face.size()) / nodes_per_face; }
};

}  // namespace delam
