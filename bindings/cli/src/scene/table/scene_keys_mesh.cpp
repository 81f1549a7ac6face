// SPDX-License-Identifier: BSD-3-Clause
// Keys of [mesh] and of its generators.
#include <algorithm>

#include "mesh/cell_shape.hpp"
#include "scene/table/scene_keys.hpp"

namespace cli {

namespace {

const std::vector<std::string> planes{"plane-strain", "plane-stress"};
// The generators and the keys that each has.
const std::vector<std::string> of_file{"bodies", "pieces"};
const std::vector<std::string> of_fibres{"fibres", "fraction", "radius", "arrangement",
                                         "aspect", "edge_gap", "seed",   "cells_around"};
const std::vector<std::string> of_weave{"spacing", "width", "thickness", "height", "section", "stacked"};

KeyRow cell_key() {
    std::vector<std::string> shapes = fibre_cell_shapes();
    for (std::string& shape : weave_shapes()) shapes.push_back(std::move(shape));
    return choice_key("cell", shapes);
}

KeyTable mesh_table() {
    KeyTable table{"mesh", "a mesh from a file or a generator", {}, {}};
    table.rows = {
        text_key("file").says("a mesh from Gmsh (.msh) or Abaqus (.inp), relative to the scene file"),
        choice_key("generator", {"fibre-cell", "weave"}).says("instead of file: Gmsh makes the mesh of a cell"),
        choice_key("plane", planes).otherwise("\"plane-strain\"").says("2D only"),
        texts_key("bodies").says(".inp only: the element sets that are the bodies"),
        flag_key("pieces").says("pieces of a body that no node connects become bodies of their own"),
        number_key("fraction", fraction).says("fibre-cell: area fraction of the fibres"),
        number_key("radius", positive).says("fibre-cell: of a fibre"),
        whole_key("fibres", 1).says("fibre-cell: number of fibres (random)"),
        choice_key("arrangement", {"random", "square", "hexagonal"}).otherwise("\"random\"").says("fibre-cell"),
        whole_key("seed", 0).otherwise("1").says("fibre-cell: each seed gives another arrangement (random)"),
        number_key("gap", not_negative)
            .otherwise("0.1 of the radius or thickness")
            .says(
                "fibre-cell: smallest gap between two fibres, in radii (random); weave: matrix between crossing yarns"),
        number_key("edge_gap", not_negative)
            .otherwise("0.1")
            .says("fibre-cell: avoids slivers at edges, in radii (random)"),
        number_key("aspect", positive).otherwise("1").says("fibre-cell: height over width of the cell"),
        whole_key("cells_around", 8).otherwise("32").says("fibre-cell: cells around a fibre; or give h"),
        number_key("spacing", positive).says("weave: of the yarns of one direction"),
        number_key("width", positive).says("weave: of a yarn"),
        number_key("thickness", positive).says("weave: of a yarn"),
        choice_key("section", {"lens", "ellipse"}).otherwise("\"lens\"").says("weave: of a yarn"),
        number_key("height", positive).otherwise("the fabric and two gaps").says("weave: of the cell"),
        flag_key("stacked").says("weave: periodic along z as well"),
        number_key("h", positive).says("edge of a cell (generators)"),
        cell_key().otherwise("\"tri6\" of a fibre-cell, \"tet10\" of a weave").says("type of the cells (generators)"),
    };
    using enum KeyRule::Kind;
    const std::vector<std::string> generated{"generator"};
    table.rules = {
        {exactly_one, {"file", "generator"}, {}, {}, "give either file or generator"},
        {needs, of_file, {"file"}, {}, "is for file"},
        {only_where, of_fibres, generated, {"fibre-cell"}, "is for generator = \"fibre-cell\""},
        {only_where, of_weave, generated, {"weave"}, "is for generator = \"weave\""},
        {needs, {"gap", "h", "cell"}, generated, {}, "is for a generator"},
        {excludes, {"plane"}, {"spacing"}, {}, "is for plane meshes only"},
        {only_where,
         {"fibres", "gap", "edge_gap", "seed"},
         {"arrangement"},
         {"random"},
         "is for the random arrangement only"},
        {only_where,
         {"aspect"},
         {"arrangement"},
         {"random", "square"},
         "a hexagonal arrangement has its own, the square root of 3"},
        {at_most_one, {"h", "cells_around"}, {}, {}, "give either h or cells_around"},
    };
    for (const char* key : {"fraction", "radius"})
        table.rules.push_back({needed_where, {key}, generated, {"fibre-cell"}, "is missing: a number is expected"});
    for (const char* key : {"spacing", "width", "thickness", "h"})
        table.rules.push_back(
            {needed_where, {key}, generated, {"weave"}, "is missing: a number > 0 (finite) is expected"});
    return table;
}

}  // namespace

std::vector<KeyTable> mesh_tables() { return {mesh_table()}; }

}  // namespace cli
