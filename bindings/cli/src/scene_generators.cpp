// SPDX-License-Identifier: BSD-3-Clause
#include "scene_generators.hpp"

#include <utility>

#include "cell_shape.hpp"
#include "gmsh_module.hpp"

namespace cli {

namespace {

MeshData fibre_cell(const Table& table) {
    table.only({"generator", "plane", "fibres", "fraction", "radius", "arrangement", "aspect", "gap", "edge_gap",
                "seed", "cells_around", "h", "cell"});
    FibreCell cell;
    cell.place = table.place();
    cell.arrangement = table.choice("arrangement", {"random", "square", "hexagonal"}, cell.arrangement);
    const bool random = cell.arrangement == "random";
    for (const char* key : {"fibres", "gap", "edge_gap", "seed"})
        if (!random && table.has(key)) table.fail(key, "is for the random arrangement only");
    if (cell.arrangement == "hexagonal" && table.has("aspect"))
        table.fail("aspect", "a hexagonal arrangement has its own, the square root of 3");
    if (random) cell.fibres = table.whole("fibres", 1);
    cell.fraction = table.number("fraction", fraction);
    cell.radius = table.number("radius", positive);
    cell.aspect = table.number("aspect", positive, cell.aspect);
    cell.gap = table.number("gap", not_negative, cell.gap);
    cell.edge_gap = table.number("edge_gap", not_negative, cell.edge_gap);
    cell.seed = static_cast<std::uint64_t>(table.whole("seed", 0, static_cast<std::int64_t>(cell.seed)));
    if (table.has("h") && table.has("cells_around")) table.fail("h", "give either h or cells_around");
    if (table.has("h")) cell.h = table.number("h", positive);
    cell.cells_around = table.whole("cells_around", 8, cell.cells_around);
    cell.cell = shape_named(table.choice("cell", fibre_cell_shapes(), "tri6")).type;
    return gmsh_module(cell.place).fibre_cell(cell);
}

MeshData weave(const Table& table) {
    table.only({"generator", "spacing", "width", "thickness", "gap", "height", "section", "stacked", "h", "cell"});
    WeaveCell cell;
    cell.place = table.place();
    cell.spacing = table.number("spacing", positive);
    cell.width = table.number("width", positive);
    cell.thickness = table.number("thickness", positive);
    cell.gap = table.number("gap", positive, 0.1 * cell.thickness);
    if (table.has("height")) cell.height = table.number("height", positive);
    cell.section = table.choice("section", {"lens", "ellipse"}, cell.section);
    cell.stacked = table.flag("stacked", cell.stacked);
    cell.h = table.number("h", positive);
    cell.cell = shape_named(table.choice("cell", weave_shapes(), "tet10")).type;
    return gmsh_module(cell.place).weave(cell);
}

}  // namespace

MeshData read_generator(const Table& table) {
    const std::string name = table.choice("generator", {"fibre-cell", "weave"}, "");
    return name == "weave" ? weave(table) : fibre_cell(table);
}

}  // namespace cli
