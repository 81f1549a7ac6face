// SPDX-License-Identifier: BSD-3-Clause
// Names of the library's cell types in mesh and result files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace cli {

struct CellFormat {
    std::int32_t type;      // a delam_cell_type
    std::string_view xdmf;  // XDMF's name, and its number in a topology of mixed cells; its node orders are VTK's
    std::int64_t xdmf_number;
    int gmsh;                                  // Gmsh's element type
    std::span<const std::uint8_t> gmsh_order;  // node of Gmsh's that each node is; empty: the same order
};

// The row of a cell type; Failure where the program has no names for it.
const CellFormat& format_of(std::int32_t type);
// The row of an element type of Gmsh; nullptr where it is no cell of the library.
const CellFormat* format_of_gmsh(int element);
// XDMF's name of the faces of an interface with so many nodes each; Failure where it has none.
std::string_view xdmf_face(std::int32_t dimension, std::int32_t nodes);

}  // namespace cli
