// SPDX-License-Identifier: BSD-3-Clause
// Points of a face, linear or curved, as combinations of its nodes.
#pragma once

#include <array>
#include <vector>

#include "mesh/box_tree.hpp"
#include "mesh/faces.hpp"
#include "mesh/mesh.hpp"

namespace delam {

// x = sum_i N_i x_i; a field linear in space has the value sum_i N_i u_i there, on curved faces too.
struct FacePoint {
    std::array<double, most_face_nodes> weight{};  // N_i, summing to 1
    Point place{};
    Point normal{};        // outward, unit
    double stretch = 0.0;  // length (2D) or area of the face per that of its reference cell there
};

// The point of an edge of the plane at -1 <= t <= 1, from its first corner to its second.
FacePoint point_of_edge(const Mesh& mesh, const BoundaryFace& face, double t);
// Returns by how much the tangents of a face vary, relative to those at its centre: 0 if its map from the reference
// cell is affine.
double distortion(const Mesh& mesh, const BoundaryFace& face);

// Contains the normals of a face at its nodes and its centre.
struct NormalCone {
    Point axis{};        // the normal at the centre, unit
    double angle = 0.0;  // the largest to the axis, rad
};
NormalCone normal_cone(const Mesh& mesh, const BoundaryFace& face);

// The point of a face nearest to x, found by Gauss-Newton steps on |x(xi) - x|^2: reliable if x is closer to the face
// than its radius of curvature.
FacePoint closest_point(const Mesh& mesh, const BoundaryFace& face, const Point& x);

// Points spread over the inside of a face, some of them just beside its nodes, for testing whether another face covers
// it. The first one is the centre.
std::vector<FacePoint> inner_points(const Mesh& mesh, const BoundaryFace& face);

}  // namespace delam
