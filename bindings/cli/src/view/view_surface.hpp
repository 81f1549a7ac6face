// SPDX-License-Identifier: BSD-3-Clause
// The visible part of a mesh: in the plane its cells, in space the faces of the bodies that no other cell of the body
// covers; and the interfaces. Only the nodes of these are kept.
#pragma once

#include <cstdint>
#include <vector>

#include "view/view_fields.hpp"

namespace cli {

// Polygons, or lines along an interface in the plane: nodes of polygon i at offsets[i] to offsets[i + 1].
struct Polygons {
    std::vector<std::int32_t> offsets{0}, nodes;

    [[nodiscard]] std::size_t count() const { return offsets.size() - 1; }
};

struct SeenInterface {
    std::vector<std::int32_t> a, b;  // the seen node of each pair; a is empty for an obstacle
    Polygons faces;                  // of pairs
};

struct Seen {
    std::vector<std::int64_t> nodes;  // the node of the mesh that each one is, ascending
    Polygons faces;                   // without those of interfaces
    std::vector<std::int64_t> cells;  // the cell of each face
    std::vector<SeenInterface> interfaces;
};

// Failure for cells of a shape that the library does not have. path: of the file, for messages.
Seen seen_of(const ViewMesh& mesh, const std::vector<ViewInterface>& interfaces, const std::string& path);

}  // namespace cli
