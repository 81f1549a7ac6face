// SPDX-License-Identifier: BSD-3-Clause
// Answers questions of the host about cell types with rows of the library's table.
#include "mesh/cell_type.hpp"

#include <algorithm>

#include "base/numbers.hpp"
#include "delam/delam.h"

namespace {

const delam::CellRow* row_at(std::int64_t place) {
    return place >= 0 && place < delam_cell_type_count() ? &delam::cell_rows[delam::index(place)] : nullptr;
}

std::size_t most_nodes_of_face(const delam::CellTopology& cell) {
    std::size_t most = 0;
    for (const delam::CellFace& face : cell.all_faces()) most = std::max(most, face.nodes);
    return most;
}

}  // namespace

int64_t delam_cell_type_count(void) { return static_cast<std::int64_t>(delam::cell_rows.size()); }

int32_t delam_cell_type_info(int64_t index, const char** name, int32_t* cell_type, int32_t* dimension, int32_t* nodes,
                             int32_t* corners, int32_t* faces, int32_t* face_nodes, int32_t* face_corners) {
    const delam::CellRow* row = row_at(index);
    if (row == nullptr) return DELAM_ERROR_ARGUMENT;
    const delam::CellTopology& cell = row->topology;
    if (name != nullptr) *name = cell.name;
    if (cell_type != nullptr) *cell_type = static_cast<std::int32_t>(row->type);
    if (dimension != nullptr) *dimension = cell.dimension;
    if (nodes != nullptr) *nodes = cell.nodes;
    if (corners != nullptr) *corners = cell.corners;
    if (faces != nullptr) *faces = cell.faces;
    if (face_nodes != nullptr) *face_nodes = static_cast<std::int32_t>(most_nodes_of_face(cell));
    if (face_corners != nullptr) {
        *face_corners = 0;
        for (const delam::CellFace& face : cell.all_faces())
            *face_corners = std::max(*face_corners, static_cast<std::int32_t>(cell.corners_of(face).size()));
    }
    return DELAM_OK;
}

int32_t delam_cell_type_topology(int64_t index, int32_t* face, int32_t* middle) {
    const delam::CellRow* row = row_at(index);
    if (row == nullptr) return DELAM_ERROR_ARGUMENT;
    const delam::CellTopology& cell = row->topology;
    const std::size_t columns = most_nodes_of_face(cell);
    for (int f = 0; f < cell.faces && face != nullptr; ++f) {
        const std::span<const int> own = cell.face[delam::index(f)].all();
        face = std::fill_n(std::copy(own.begin(), own.end(), face), columns - own.size(), -1);
    }
    for (int m = 0; m < cell.nodes - cell.corners && middle != nullptr; ++m)
        middle = std::copy_n(cell.middle[delam::index(m)].begin(), 2, middle);
    return DELAM_OK;
}
