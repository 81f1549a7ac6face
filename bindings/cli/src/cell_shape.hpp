// SPDX-License-Identifier: BSD-3-Clause
// The topology of the library's cell types, in its node order (delam.h).
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace cli {

struct CellShape {
    std::int32_t type;  // a delam_cell_type
    std::string_view name;
    std::int32_t dimension;
    std::size_t nodes;
    std::size_t corners;
    // Nodes of each side, corners first, then the nodes midway; in the order in which Abaqus numbers sides, from S1.
    std::vector<std::vector<std::size_t>> sides;
};

const CellShape& shape_of(std::int32_t type);
std::span<const CellShape> all_shapes();

}  // namespace cli
