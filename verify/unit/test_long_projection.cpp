// SPDX-License-Identifier: BSD-3-Clause
// Projection of curved faces on meshes as fine along the axis of the cylinder as around it.

#include "check.hpp"
#include "projection.hpp"

using delam::CellType;

TEST(curved) {
    for (const CellType type :
         {CellType::quad4, CellType::quad8, CellType::tri6, CellType::hex8, CellType::hex20, CellType::tet10})
        for (const std::int64_t n : {4, 8}) unit::expect_curved(type, n, unit::stack(type, type, n, 2 * n + 1));
}
