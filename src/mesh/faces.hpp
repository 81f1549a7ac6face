// SPDX-License-Identifier: BSD-3-Clause
// Finds the faces that cells share.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/numbers.hpp"
#include "mesh/box_tree.hpp"
#include "mesh/mesh.hpp"

namespace delam {

// A face that one cell alone has: cell, its nodes (corners outward, then the others), in order of cells and local
// faces.
struct BoundaryFace {
    std::int64_t cell;
    int nodes;
    int corners;
    std::array<std::int64_t, most_face_nodes> node;

    std::span<const std::int64_t> all() const { return std::span(node).first(index(nodes)); }
    std::span<const std::int64_t> corner() const { return all().first(index(corners)); }
    std::span<const std::int64_t> middle() const { return all().subspan(index(corners)); }
};
// body -1: of all bodies.
std::vector<BoundaryFace> boundary_faces(const Mesh& mesh, std::int32_t body);

// Neighbours across faces among some cells of a mesh: the neighbour of cells[i] across its local face f is
// cells[neighbour[i*stride + f]]; negative: none.
struct FaceTable {
    static constexpr std::int64_t stride = 6;
    std::vector<std::int64_t> neighbour;
};
// Finds the faces that cells share. At most two cells may share the corners of a face. They must lie on both sides of
// it and share its mid-side nodes too; otherwise Error(DELAM_ERROR_MESH).
FaceTable match_faces(const Mesh& mesh, std::span<const std::int64_t> cells);

// A local face of a cell, whether another cell has it or not.
BoundaryFace face_of(const Mesh& mesh, std::int64_t cell, std::size_t face);

// Outward area vector of a face: its length (2D) or area (3D) times the mean unit normal; of a curved one in 3D, that
// of its linear pieces. Third component 0 in 2D.
std::array<double, 3> area_vector(const Mesh& mesh, std::span<const std::int64_t> nodes);

// Smallest distance between neighbouring nodes of some cells: of quadratic ones, from a corner to a mid-side node.
double shortest_edge(const Mesh& mesh, std::span<const std::int64_t> cells);

// Box around the nodes of a face, widened on all sides.
Box box_of(const Mesh& mesh, const BoundaryFace& face, double widened);

// Doubles the nodes of faces that two cells of one body share, so that both sides are outer faces there: a seam
// (pairing/seams.hpp). A node around which the cells stay connected across other faces, as at the tip of a crack, stays
// one. faces: [count][per_face] nodes of each face, its corners or all of them, in any order; one may occur twice, and
// the original of a copy stands for it. Returns the number of new nodes, which are copies (Mesh::node_origin). On an
// error the mesh is unchanged.
std::int64_t cut(Mesh& mesh, std::span<const std::int64_t> faces, std::size_t per_face);

}  // namespace delam
