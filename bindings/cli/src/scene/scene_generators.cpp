// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene_generators.hpp"

#include <utility>

#include "mesh/cell_shape.hpp"
#include "mesh/gmsh/gmsh_module.hpp"

namespace cli {

namespace {

MeshData fibre_cell(const Table& table) {
    FibreCell cell;
    cell.place = table.place();
    cell.arrangement = table.text("arrangement");
    const bool random = cell.arrangement == "random";
    if (random) cell.fibres = table.whole("fibres");
    cell.fraction = table.number("fraction");
    cell.radius = table.number("radius");
    cell.aspect = table.number("aspect", cell.aspect);
    cell.gap = table.number("gap", cell.gap);
    cell.edge_gap = table.number("edge_gap", cell.edge_gap);
    cell.seed = static_cast<std::uint64_t>(table.whole("seed", static_cast<std::int64_t>(cell.seed)));
    if (table.has("h")) cell.h = table.number("h");
    cell.cells_around = table.whole("cells_around", cell.cells_around);
    cell.cell = shape_named(table.choice("cell", fibre_cell_shapes(), "tri6")).type;
    return gmsh_module(cell.place).fibre_cell(cell);
}

MeshData weave(const Table& table) {
    WeaveCell cell;
    cell.place = table.place();
    cell.spacing = table.number("spacing");
    cell.width = table.number("width");
    cell.thickness = table.number("thickness");
    cell.gap = table.number("gap", 0.1 * cell.thickness);
    if (!(cell.gap > 0)) table.fail("gap", "0 is not allowed: > 0 (finite)");
    if (table.has("height")) cell.height = table.number("height");
    cell.section = table.text("section");
    cell.stacked = table.flag("stacked");
    cell.h = table.number("h");
    cell.cell = shape_named(table.choice("cell", weave_shapes(), "tet10")).type;
    return gmsh_module(cell.place).weave(cell);
}

}  // namespace

MeshData read_generator(const Table& table) {
    const std::string name = table.text("generator");
    return name == "weave" ? weave(table) : fibre_cell(table);
}

}  // namespace cli
