// SPDX-License-Identifier: BSD-3-Clause
// Builds an interface from node pairs and their faces: order, weights, frames.
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "mesh/faces.hpp"
#include "mesh/mesh.hpp"
#include "mesh/rule/mid_sides.hpp"

namespace delam {

using NodePair = std::pair<std::int64_t, std::int64_t>;  // of a, of b

// `faces` have the nodes that `side` selects from the pairs (all of them), and face from a to b. The positions of these
// nodes order the pairs; coordinates closer than `distance` count as equal. Weights and normals are those of the faces.
// The caller sets the bodies.
enum class FaceSide { a, b };
NewInterface assemble_interface(const Mesh& mesh, std::span<const NodePair> pairs, std::span<const BoundaryFace> faces,
                                FaceSide side, double distance);
// The same where a node of side a may have several pairs: of_faces has the pair of each node of each face. Nodes that
// are their own partners have no pair: their faces add to the weights and normals of the others, and are left out.
NewInterface assemble_interface(const Mesh& mesh, std::span<const NodePair> pairs, std::span<const BoundaryFace> faces,
                                std::span<const std::vector<NodePair>> of_faces, double distance);

// Fills weights and faces of an interface that has its pairs, all at the nodes themselves. Pairs on no face have weight
// 0.
void lay_faces(const Mesh& mesh, std::span<const BoundaryFace> faces, FaceSide side, InterfaceGeometry& interface);

// The same face with the opposite orientation.
BoundaryFace turned(const BoundaryFace& face);

// Returns the normal that the host gives for a pair, of any length; refuses one that is not finite or has length 0.
// normals: [pairs][dimension]
std::array<double, 3> require_normal(int dimension, std::span<const double> normals, std::size_t pair);
// Refuses a weight that the host gives and that is not positive and finite. weights: [pairs]
void require_weight(std::span<const double> weights, std::size_t pair);

// Rows normal, tangent(s), from any vector along the normal: [dimension][dimension].
void write_frame(int dimension, const std::array<double, 3>& along, double* frame);

}  // namespace delam
