// SPDX-License-Identifier: BSD-3-Clause
// A periodic plane cell of equal fibres in a matrix, seen along the fibres.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesh/mesh_data.hpp"
#include "text/error.hpp"

namespace cli {

struct FibreCell {
    std::int64_t fibres = 1;             // only for random; square has 1, hexagonal 2
    double fraction = 0.5;               // area of fibres over that of the cell
    double radius = 1.0;                 // L; the size of the cell follows
    std::string arrangement = "random";  // square (one fibre in the middle) or hexagonal
    double aspect = 1.0;                 // height over width
    double gap = 0.1;                    // between fibres at least, in radii (random)
    double edge_gap = 0.1;               // packing.hpp, in radii (random)
    std::uint64_t seed = 1;
    std::int64_t cells_around = 32;  // a fibre; >= 8
    double h = 0;                    // L, instead: edge of a cell; 0: 2 pi radius / cells_around
    std::int32_t cell = 0;           // of fibre_cell_shapes(); quadrilaterals with triangles where they do not fit
    Place place;                     // of the table, for messages
};

// Origin in a corner of the cell; bodies matrix, fibre-1, fibre-2, ..; a fibre cut by the border continues on the
// opposite side and is one body. Opposite borders have the same nodes, shifted by the period. Node sets left, right,
// bottom, top, corners, origin. Sides of quadratic cells lie on the circles. Throws SceneFailure.
MeshData generate_fibre_cell(const FibreCell& cell);

}  // namespace cli
