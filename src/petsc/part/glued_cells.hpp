// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "delam/delam.h"

namespace delam::petsc {

// The cells of a mesh as a graph. A vertex is a cell, or all cells that paired faces join across interfaces; neighbours
// share a face.
struct GluedCells {
    std::vector<std::int64_t> vertex;     // of each cell
    std::vector<std::int64_t> cells;      // number of cells of each vertex
    std::vector<std::int64_t> start;      // of its neighbours
    std::vector<std::int64_t> neighbour;  // ascending
};

GluedCells glue_cells(const delam_mesh* mesh);

}  // namespace delam::petsc
