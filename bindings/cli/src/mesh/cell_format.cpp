// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/cell_format.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "delam/delam.h"
#include "mesh/cell_shape.hpp"
#include "text/error.hpp"

namespace cli {

namespace {

// The library's node orders are VTK's, and Abaqus's but for wedges; Abaqus numbers the sides S1, S2, .. of these cells
// in the order of the library's faces. Which element types of Abaqus are which cells: abaqus_elements.cpp.
constexpr std::uint8_t tetrahedron_10[] = {0, 1, 2, 3, 4, 5, 6, 7, 9, 8};
constexpr std::uint8_t hexahedron_20[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15};
constexpr std::uint8_t hexahedron_27[] = {0,  1,  2,  3,  4,  5,  6,  7,  8,  11, 13, 9,  16, 18,
                                          19, 17, 10, 12, 14, 15, 22, 23, 21, 24, 20, 25, 26};
constexpr std::uint8_t wedge_6[] = {3, 4, 5, 0, 1, 2};
constexpr std::uint8_t wedge_15[] = {3, 4, 5, 0, 1, 2, 12, 14, 13, 6, 9, 7, 8, 10, 11};
constexpr CellFormat formats[] = {
    {DELAM_TRI3, "Triangle", 4, 2, {}},
    {DELAM_QUAD4, "Quadrilateral", 5, 3, {}},
    {DELAM_TET4, "Tetrahedron", 6, 4, {}},
    {DELAM_HEX8, "Hexahedron", 9, 5, {}},
    {DELAM_TRI6, "Triangle_6", 36, 9, {}},
    {DELAM_QUAD8, "Quadrilateral_8", 37, 16, {}},
    {DELAM_QUAD9, "Quadrilateral_9", 35, 10, {}},
    {DELAM_TET10, "Tetrahedron_10", 38, 11, tetrahedron_10},
    {DELAM_HEX20, "Hexahedron_20", 48, 17, hexahedron_20},
    {DELAM_HEX27, "Hexahedron_27", 50, 12, hexahedron_27},
    {DELAM_WEDGE6, "Wedge", 8, 6, wedge_6},
    {DELAM_PYRAMID5, "Pyramid", 7, 7, {}},
    {DELAM_WEDGE15, "Wedge_15", 40, 18, wedge_15},
};

}  // namespace

const CellFormat& format_of(std::int32_t type) {
    for (const CellFormat& format : formats)
        if (format.type == type) return format;
    throw Failure(exit_output, fmt::format("cells of type {} have no name in files", shape_of(type).name));
}

const CellFormat* format_of_gmsh(int element) {
    const auto* at = std::find_if(std::begin(formats), std::end(formats),
                                  [element](const CellFormat& format) { return format.gmsh == element; });
    return at == std::end(formats) ? nullptr : at;
}

std::string_view xdmf_face(std::int32_t dimension, std::int32_t nodes) {
    if (dimension == 2 && nodes == 2) return "Polyline";
    if (dimension == 2 && nodes == 3) return "Edge_3";
    // A face in space is a plane cell.
    for (const CellShape& shape : all_shapes())
        if (dimension == 3 && shape.dimension == 2 && shape.nodes == static_cast<std::size_t>(nodes))
            return format_of(shape.type).xdmf;
    throw Failure(exit_output, fmt::format("faces of {} nodes in {}D have no name in XDMF", nodes, dimension));
}

}  // namespace cli
