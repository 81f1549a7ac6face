// SPDX-License-Identifier: BSD-3-Clause
#include "cell_shape.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "delam/delam.h"

namespace cli {

std::span<const CellShape> all_shapes() {
    // Abaqus: "Two-dimensional solid element library" and "Three-dimensional solid element library", element faces.
    static const std::array<CellShape, 9> shapes{{
        {DELAM_TRI3, "tri3", 2, 3, 3, {{0, 1}, {1, 2}, {2, 0}}},
        {DELAM_QUAD4, "quad4", 2, 4, 4, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}},
        {DELAM_TET4, "tet4", 3, 4, 4, {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}},
        {DELAM_HEX8,
         "hex8",
         3,
         8,
         8,
         {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}}},
        {DELAM_TRI6, "tri6", 2, 6, 3, {{0, 1, 3}, {1, 2, 4}, {2, 0, 5}}},
        {DELAM_QUAD8, "quad8", 2, 8, 4, {{0, 1, 4}, {1, 2, 5}, {2, 3, 6}, {3, 0, 7}}},
        {DELAM_QUAD9, "quad9", 2, 9, 4, {{0, 1, 4}, {1, 2, 5}, {2, 3, 6}, {3, 0, 7}}},
        {DELAM_TET10,
         "tet10",
         3,
         10,
         4,
         {{0, 1, 2, 4, 5, 6}, {0, 3, 1, 7, 8, 4}, {1, 3, 2, 8, 9, 5}, {2, 3, 0, 9, 7, 6}}},
        {DELAM_HEX20,
         "hex20",
         3,
         20,
         8,
         {{0, 1, 2, 3, 8, 9, 10, 11},
          {4, 7, 6, 5, 15, 14, 13, 12},
          {0, 4, 5, 1, 16, 12, 17, 8},
          {1, 5, 6, 2, 17, 13, 18, 9},
          {2, 6, 7, 3, 18, 14, 19, 10},
          {3, 7, 4, 0, 19, 15, 16, 11}}},
    }};
    return shapes;
}

const CellShape& shape_of(std::int32_t type) {
    const auto shapes = all_shapes();
    const auto at = std::find_if(shapes.begin(), shapes.end(), [type](const CellShape& s) { return s.type == type; });
    if (at == shapes.end()) throw std::logic_error("a cell type that the program does not know");
    return *at;
}

}  // namespace cli
