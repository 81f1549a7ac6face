// SPDX-License-Identifier: BSD-3-Clause
// Which cells share which faces.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.hpp"

namespace delam {

// Position of a signed index in a standard container.
constexpr std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

// Neighbours across faces among some cells of a mesh: of cells[i] across its local face f it is
// cells[neighbour[i*stride + f]]; negative: nobody.
struct FaceTable {
    static constexpr std::int64_t stride = 6;
    std::vector<std::int64_t> neighbour;
};
// Cells that share a face must lie on both sides of it, two at most: Error(DELAM_ERROR_MESH) otherwise.
FaceTable match_faces(const Mesh& mesh, std::span<const std::int64_t> cells);

// Mesh nodes of a local face, outward when walked in order; the first topology(type).face_nodes entries are used.
std::array<std::int64_t, 4> face_nodes(const Mesh& mesh, std::int64_t cell, int face);

// Outward area vector of a face: its length (2D) or area (3D) times the mean unit normal. Third component 0 in 2D.
std::array<double, 3> area_vector(const Mesh& mesh, std::span<const std::int64_t> nodes);

}  // namespace delam
