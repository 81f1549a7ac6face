// SPDX-License-Identifier: BSD-3-Clause
// The library's cell types as it lists them (delam_cell_type_info), in its node order.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cli {

struct CellShape {
    std::int32_t type;  // a delam_cell_type
    std::string name;
    std::int32_t dimension;
    std::size_t nodes;
    std::size_t corners;
    std::vector<std::vector<std::size_t>> sides;      // nodes of each: corners, outward in order, then those midway
    std::vector<std::array<std::size_t, 2>> middles;  // corners that each node behind the corners is midway between

    // The corners of one of its sides.
    [[nodiscard]] std::span<const std::size_t> corners_of(const std::vector<std::size_t>& side) const;
    [[nodiscard]] bool simplex() const { return corners == static_cast<std::size_t>(dimension) + 1; }
    [[nodiscard]] bool linear() const { return nodes == corners; }
    // True if the cell, a quadrilateral or a hexahedron, can have incompatible modes (delam_problem_set_formulation),
    // and has them by default.
    [[nodiscard]] bool has_modes() const { return linear() && corners == std::size_t{1} << dimension; }
    // True if it is far too stiff in bending unless many lie across the thickness.
    [[nodiscard]] bool locks() const { return linear() && !has_modes(); }
};

// Returns the cell to use where one that locks does not do.
const CellShape& instead_of(const CellShape& shape);
// Failure for a number that is no cell type, or a name.
const CellShape& shape_of(std::int32_t type);
const CellShape& shape_named(const std::string& name);
std::span<const CellShape> all_shapes();
std::vector<std::string> shape_names(bool (*wanted)(const CellShape&));
std::vector<std::string> shape_names(std::int32_t dimension);
// Return the names of the shapes that the generators make.
std::vector<std::string> fibre_cell_shapes();
std::vector<std::string> weave_shapes();

}  // namespace cli
