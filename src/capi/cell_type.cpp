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
    if (face_nodes != nullptr) *face_nodes = cell.face_nodes;
    if (face_corners != nullptr) *face_corners = cell.face_corners;
    return DELAM_OK;
}

int32_t delam_cell_type_topology(int64_t index, int32_t* face, int32_t* middle) {
    const delam::CellRow* row = row_at(index);
    if (row == nullptr) return DELAM_ERROR_ARGUMENT;
    const delam::CellTopology& cell = row->topology;
    for (int f = 0; f < cell.faces && face != nullptr; ++f)
        face = std::copy_n(cell.face[delam::index(f)].begin(), cell.face_nodes, face);
    for (int m = 0; m < cell.nodes - cell.corners && middle != nullptr; ++m)
        middle = std::copy_n(cell.middle[delam::index(m)].begin(), 2, middle);
    return DELAM_OK;
}
