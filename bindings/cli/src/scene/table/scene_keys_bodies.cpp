// SPDX-License-Identifier: BSD-3-Clause
// Keys of [geometry], [[materials]], [[layers]] and [[bodies]].
#include "mesh/cell_shape.hpp"
#include "scene/table/scene_keys.hpp"

namespace cli {

namespace {

std::vector<std::string> shapes_of_blocks() {
    std::vector<std::string> names = shape_names(2);
    for (std::string& name : shape_names(3)) names.push_back(std::move(name));
    return names;
}

KeyTable geometry_table() {
    KeyTable table{"geometry", "a block of layers and its mesh", {}, {}};
    KeyRow divisions = whole_key("divisions", 1).says("numbers of cells, instead of h; 3D: [nx, ny]");
    divisions.kind = KeyKind::wholes;
    table.rows = {
        whole_key("dimension", 2, 3).need().says("layers are stacked along the last axis (y in 2D, z in 3D)"),
        number_key("length", positive).need().says("along x"),
        number_key("width", positive).says("along y, 3D only"),
        divisions.entries(1, 2).or_alone(),
        number_key("h", positive).says("edge of a cell; length, width and thicknesses are multiples of it"),
        choice_key("cell", shapes_of_blocks()).otherwise("\"quad4\" in 2D, \"hex8\" in 3D").says("type of the cells"),
        choice_key("plane", {"plane-strain", "plane-stress"}).otherwise("\"plane-strain\"").says("2D only"),
    };
    table.rules = {
        {KeyRule::exactly_one,
         {"h", "divisions"},
         {},
         {},
         "give either h (edge of a cell) or divisions (numbers of cells)"},
        {KeyRule::only_where, {"plane"}, {"dimension"}, {"2"}, "is for dimension 2 only"},
        {KeyRule::only_where, {"width"}, {"dimension"}, {"3"}, "is for dimension 3 only"},
        {KeyRule::needed_where, {"width"}, {"dimension"}, {"3"}, "is missing: a number > 0 (finite) is expected"},
    };
    return table;
}

KeyRow formulation_key() { return choice_key("formulation", {"standard", "incompatible", "mean-dilatation"}); }

KeyTable material_table() {
    KeyTable table{"material", "an elastic material", {}, {}};
    table.rows = {
        text_key("name").need().says("by which layers and bodies refer to it"),
        number_key("young", positive)
            .says("Young's modulus of an isotropic material")
            .written({"E", "e", "modulus", "youngs_modulus"}),
        number_key("poisson", poisson_range)
            .says("Poisson's ratio of an isotropic material")
            .written({"nu", "v", "poissons_ratio"}),
    };
    for (const char* key : {"E1", "E2", "E3"})
        table.rows.push_back(number_key(key, positive).says("Young's modulus along an axis of the material"));
    for (const char* key : {"nu12", "nu13", "nu23"})
        table.rows.push_back(number_key(key).says("contraction along the second axis under tension along the first"));
    for (const char* key : {"G12", "G13", "G23"}) table.rows.push_back(number_key(key, positive).says("shear modulus"));
    KeyRow expansion = numbers_key("expansion")
                           .entries(3, 3)
                           .or_alone()
                           .says("thermal expansion per degree along the material's axes, or along all");
    table.rows.push_back(expansion);
    table.rows.push_back(formulation_key()
                             .otherwise("incompatible for quad4 and hex8, standard for other cells")
                             .says("of the finite elements"));

    const std::vector<std::string> five{"E1", "E2", "nu12", "nu23", "G12"}, four{"E3", "nu13", "G13", "G23"};
    std::vector<std::string> nine = five;
    nine.insert(nine.end(), four.begin(), four.end());
    table.rules.push_back({KeyRule::excludes,
                           {"young", "poisson"},
                           nine,
                           {},
                           "give either young and poisson or the constants of an orthotropic material, E1, E2, ..."});
    std::vector<std::string> any = nine;
    any.insert(any.begin(), "young");
    table.rules.push_back({KeyRule::at_least_one, any, {}, {}, "is missing: a number > 0 (finite) is expected"});
    table.rules.push_back(
        {KeyRule::needs, {"young"}, {"poisson"}, {}, "is missing: a number in (-1, 0.5) is expected"});
    table.rules.push_back(
        {KeyRule::needs, {"poisson"}, {"young"}, {}, "is missing: a number > 0 (finite) is expected"});
    for (const std::string& key : nine)
        table.rules.push_back({KeyRule::needs,
                               four,
                               {key},
                               {},
                               "is missing: an orthotropic material has E1, E2, E3, nu12, nu13, nu23, G12, G13, G23, a "
                               "transversely isotropic one E1, E2, nu12, nu23, G12 alone"});
    for (const std::string& key : five)
        table.rules.push_back({KeyRule::needs,
                               five,
                               {key},
                               {},
                               "is missing: a transversely isotropic material has E1, E2, nu12, nu23, G12"});
    return table;
}

KeyRow axes_key() {
    KeyRow row =
        numbers_key("axes").entries(2, 2).says("directions of the material's axes 1 and 2: [[x, y, z], [x, y, z]]");
    row.kind = KeyKind::points;
    return row.each(3, 3);
}

KeyRow angle_key() {
    return number_key("angle").says("degrees, of the material's axis 1 about the stacking axis, from x");
}

KeyTable layer_table() {
    KeyTable table{"layer", "a layer of the block", {}, {}};
    table.rows = {
        text_key("name").need().says("by which interfaces and places refer to it"),
        number_key("thickness", positive).need().says("along the stacking axis"),
        whole_key("divisions", 1).says("number of cells across the thickness (default: thickness / h)"),
        text_key("material").need().says("name of a material"),
        angle_key(),
        numbers_key("angles").says("the layer is a laminate whose plies, from the bottom up, have these angles"),
        axes_key(),
    };
    table.rules = {{KeyRule::at_most_one, {"angles", "axes", "angle"}, {}, {}, "give one of angle, angles and axes"}};
    return table;
}

KeyTable body_table() {
    KeyTable table{"body", "a body of the mesh, or all that match a name with *", {}, {}};
    table.rows = {
        text_key("name").need().says("of a body of the mesh; * matches any characters"),
        text_key("material").need().says("name of a material"),
        formulation_key().otherwise("that of the material").says("of the finite elements"),
        angle_key(),
        axes_key(),
    };
    table.rules = {{KeyRule::at_most_one, {"axes", "angle"}, {}, {}, "give either angle or axes"}};
    return table;
}

}  // namespace

std::vector<KeyTable> body_tables() { return {geometry_table(), material_table(), layer_table(), body_table()}; }

}  // namespace cli
