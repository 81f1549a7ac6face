// SPDX-License-Identifier: BSD-3-Clause
// Adds interfaces to a mesh. On an error each function leaves the mesh unchanged. Bodies are given by their labels;
// except where a comment says otherwise, a function returns the number of its interface.
#pragma once

#include <cstdint>
#include <span>
#include <utility>

#include "mesh/mesh.hpp"

namespace delam {

// Pairs matching boundary faces of two bodies.
std::int64_t add_interface(Mesh& mesh, std::int32_t label_a, std::int32_t label_b, double tolerance);
// Adds an interface between every two bodies that share matching faces and have none yet, in the order of their labels;
// returns how many it has added.
std::int64_t add_all_interfaces(Mesh& mesh, double tolerance);
// Adds an interface for each connected seam, where faces of one body lie on others of it with nodes of their own;
// returns how many it has added. Nodes that both sides share, as at the tip of a seam, have no pair.
std::int64_t add_seams(Mesh& mesh, double tolerance);
// Adds an interface between each two walls of one body that face each other within `gap`, as add_mortar_interface does
// for two bodies; returns how many it has added.
std::int64_t add_self_contact(Mesh& mesh, double gap);
// Ties the nodes of b's faces to their projections on a's faces, within `gap`; appends a tied node for each.
std::int64_t add_projected_interface(Mesh& mesh, std::int32_t label_a, std::int32_t label_b, double gap);
// Pairs the nodes of b's faces with means over a's faces, within `gap`; appends a tied node for each.
std::int64_t add_mortar_interface(Mesh& mesh, std::int32_t label_a, std::int32_t label_b, double gap);
// Pairs a control node of no body with nodes of one body. normals: [nodes][dimension] into the body, any length;
// weights empty: those of the faces whose nodes are all there.
std::int64_t add_obstacle(Mesh& mesh, std::span<const std::int64_t> nodes, std::span<const double> normals,
                          std::span<const double> weights, std::int64_t control);
// Takes pairs that the host knows. normals: [pairs][dimension] from a to b, any length; face: indices of pairs,
// [faces][nodes_per_face].
std::int64_t add_pairs(Mesh& mesh, std::int32_t label_a, std::int32_t label_b, std::span<const std::int64_t> nodes_a,
                       std::span<const std::int64_t> nodes_b, std::span<const double> normals,
                       std::span<const double> weights, int nodes_per_face, std::span<const std::int64_t> face);

// Moves pairs of an interface, each listed once, into a new one between the same bodies. A face goes where all of its
// pairs are; one with pairs of both is left out, and its weight stays with its pairs.
std::int64_t split_interface(Mesh& mesh, std::int64_t interface, std::span<const std::int64_t> pairs);

// Turns the frames of an interface in space about their normals: the first tangent along the projection of a direction,
// [3] for all pairs or [pairs][3], any length > 0. Throws Error(DELAM_ERROR_MESH) where one is along the normal.
void set_tangents(Mesh& mesh, std::int64_t interface, std::span<const double> directions);

// Returns the body indices of two labels that differ and have no interface.
std::pair<std::int32_t, std::int32_t> require_unjoined(const Mesh& mesh, std::int32_t label_a, std::int32_t label_b);
// Throws Error(DELAM_ERROR_MESH) where a body has no faces.
void require_cells(const Mesh& mesh, std::int32_t body);

}  // namespace delam
