// SPDX-License-Identifier: BSD-3-Clause
// Material axes of the cells of a mesh. Cells with equal axes share them, so a cell needs only one index.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace delam {

using Axes = std::array<double, 9>;  // rows: axes 1, 2, 3 in space, orthonormal, right-handed

struct Orientation {
    std::vector<Axes> axes;             // in the order in which cells first use them
    std::vector<std::int32_t> of_cell;  // [mesh cells], -1: the global axes
};

// Axis 1 along `first`, 2 along the part of `second` normal to it, 3 = 1 x 2. False: one has length 0, or they are
// parallel.
bool orthonormal_axes(std::span<const double, 3> first, std::span<const double, 3> second, Axes& axes);

// `before` (of the same mesh, or empty) with new axes for some cells: chosen[i] for cells[i]. Equal axes are merged.
Orientation oriented(const Orientation& before, std::int64_t mesh_cells, std::span<const std::int64_t> cells,
                     std::span<const Axes> chosen);

}  // namespace delam
