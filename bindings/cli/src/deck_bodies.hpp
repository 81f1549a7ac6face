// SPDX-License-Identifier: BSD-3-Clause
// How the bodies of a mesh lie beside each other: which sides of their cells are one and the same, and which coincide.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "mesh_data.hpp"

namespace cli::abaqus {

using Face = std::array<std::int64_t, 9>;   // nodes, -1 padded
using FaceKey = std::vector<std::int64_t>;  // its corners, ascending

// The bodies on a side of cells. A side on which two bodies meet has two, unless the nodes are doubled.
class FaceBodies {
public:
    explicit FaceBodies(const MeshData& mesh);
    // Ascending and without repetitions; empty: no side of a cell.
    [[nodiscard]] std::vector<std::int32_t> of(const Face& face) const;
    [[nodiscard]] const std::map<FaceKey, std::vector<std::int32_t>>& all() const { return bodies_; }

private:
    std::int32_t dimension_;
    std::map<FaceKey, std::vector<std::int32_t>> bodies_;
};

struct BodyPair {
    std::int32_t a = 0, b = 0;  // a < b
    std::int64_t shared = 0;    // sides whose nodes belong to both
    std::int64_t doubled = 0;   // sides that coincide, with nodes of their own
};
// Nodes coincide within 1e-6 of the shortest edge.
std::vector<BodyPair> pairs_of_bodies(const MeshData& mesh, const FaceBodies& faces, double shortest_edge);

// How many of the faces coincide with one of the others.
std::int64_t coinciding_faces(const MeshData& mesh, const std::vector<Face>& faces, const std::vector<Face>& others,
                              double shortest_edge);

// Nodes in cells of each body, ascending labels.
std::vector<std::int32_t> bodies_at(const MeshData& mesh, std::int64_t node);

}  // namespace cli::abaqus
