// SPDX-License-Identifier: BSD-3-Clause
#include "base/error.hpp"
#include "delam/delam.h"
#include "mesh/mesh.hpp"

namespace delam {

// Corners first, then the nodes midway between two of them; the centre of quad9 counts as midway of a diagonal.
const CellTopology& topology(CellType type) {
    static constexpr CellTopology tri3{"tri3", 2, 3, 3, 3, 2, 2, {{{0, 1}, {1, 2}, {2, 0}}}, {}};
    static constexpr CellTopology quad4{"quad4", 2, 4, 4, 4, 2, 2, {{{0, 1}, {1, 2}, {2, 3}, {3, 0}}}, {}};
    static constexpr CellTopology tet4{"tet4", 3, 4, 4, 4, 3, 3, {{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}}, {}};
    static constexpr CellTopology hex8{
        "hex8", 3, 8, 8,
        6,      4, 4, {{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}},
        {}};
    static constexpr CellTopology tri6{
        "tri6", 2, 6, 3, 3, 3, 2, {{{0, 1, 3}, {1, 2, 4}, {2, 0, 5}}}, {{{0, 1}, {1, 2}, {2, 0}}}};
    static constexpr CellTopology quad8{
        "quad8", 2, 8, 4, 4, 3, 2, {{{0, 1, 4}, {1, 2, 5}, {2, 3, 6}, {3, 0, 7}}}, {{{0, 1}, {1, 2}, {2, 3}, {3, 0}}}};
    static constexpr CellTopology quad9{"quad9",
                                        2,
                                        9,
                                        4,
                                        4,
                                        3,
                                        2,
                                        {{{0, 1, 4}, {1, 2, 5}, {2, 3, 6}, {3, 0, 7}}},
                                        {{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 2}}}};
    static constexpr CellTopology tet10{
        "tet10",
        3,
        10,
        4,
        4,
        6,
        3,
        {{{0, 2, 1, 6, 5, 4}, {0, 1, 3, 4, 8, 7}, {1, 2, 3, 5, 9, 8}, {0, 3, 2, 7, 9, 6}}},
        {{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}}};
    static constexpr CellTopology hex20{
        "hex20",
        3,
        20,
        8,
        6,
        8,
        4,
        {{{0, 3, 2, 1, 11, 10, 9, 8},
          {4, 5, 6, 7, 12, 13, 14, 15},
          {0, 1, 5, 4, 8, 17, 12, 16},
          {1, 2, 6, 5, 9, 18, 13, 17},
          {2, 3, 7, 6, 10, 19, 14, 18},
          {3, 0, 4, 7, 11, 16, 15, 19}}},
        {{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}}};
    switch (type) {
        case CellType::tri3:
            return tri3;
        case CellType::quad4:
            return quad4;
        case CellType::tet4:
            return tet4;
        case CellType::hex8:
            return hex8;
        case CellType::tri6:
            return tri6;
        case CellType::quad8:
            return quad8;
        case CellType::quad9:
            return quad9;
        case CellType::tet10:
            return tet10;
        case CellType::hex20:
            return hex20;
    }
    fail(DELAM_ERROR_ARGUMENT, "cell type ", static_cast<std::int32_t>(type), ": must be 1 (tri3) .. 9 (hex20)");
}

}  // namespace delam
