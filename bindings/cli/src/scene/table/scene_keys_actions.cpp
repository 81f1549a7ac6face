// SPDX-License-Identifier: BSD-3-Clause
// Keys of what acts on bodies: [[patterns]], [[supports]], [[loads]], [[forces]], strains, constraints and [cell].
#include <algorithm>
#include <initializer_list>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "scene/table/scene_keys.hpp"

namespace cli {

namespace {

using Kind = KeyRule::Kind;

// The places that a table takes: "point", "box", "patch", "set", "control", and "body" alone.
using Places = std::vector<std::string>;

bool has(const Places& places, const char* place) {
    return std::find(places.begin(), places.end(), place) != places.end();
}

std::string one_of(const Places& places) { return fmt::format("give one of {}", fmt::join(places, ", ")); }

void add_places(KeyTable& table, const Places& places) {
    std::vector<KeyRow>& rows = table.rows;
    if (has(places, "point")) rows.push_back(vector_key("point").says("coordinates of a node"));
    if (has(places, "box")) rows.push_back(table_key("box", "box").says("all nodes in it"));
    if (has(places, "patch")) rows.push_back(table_key("patch", "patch").says("a part of the boundary"));
    if (has(places, "set")) rows.push_back(text_key("set").in_mesh().says("name of a set of the mesh"));
    if (has(places, "control")) rows.push_back(text_key("control").says("name of a control node"));
    rows.push_back(text_key("name").says("free text"));
    rows.push_back(number_key("tolerance", positive)
                       .otherwise("1e-3 of the shortest cell edge")
                       .says("largest distance of a node from its place"));
    rows.push_back(text_key("layer").in_layers().says("the nodes of this layer alone"));
    rows.push_back(text_key("body").in_mesh().says("the nodes of this body alone"));

    Places of_layers, of_mesh;
    for (const std::string& place : places) {
        if (place != "set" && place != "body") of_layers.push_back(place);
        if (place != "body") of_mesh.push_back(place);
    }
    table.rules.push_back({Kind::exactly_one, of_layers, {}, {}, one_of(of_layers), Scenes::layers});
    if (has(places, "body")) {
        table.rules.push_back({Kind::at_most_one, of_mesh, {}, {}, one_of(places), Scenes::mesh});
        table.rules.push_back({Kind::at_least_one, places, {}, {}, one_of(places), Scenes::mesh});
    } else {
        table.rules.push_back({Kind::exactly_one, of_mesh, {}, {}, one_of(of_mesh), Scenes::mesh});
    }
    if (has(places, "control"))
        table.rules.push_back(
            {Kind::excludes, {"layer", "body"}, {"control"}, {}, "is not for a control node: it is of none"});
}

const Places any_place{"point", "box", "patch", "set", "body", "control"};

void add_direction(KeyTable& table, const char* key) {
    KeyRow components = texts_key(key).says("components by letter");
    components.entries(1, 3).choices = {"x", "y", "z"};
    table.rows.push_back(components);
    table.rows.push_back(vector_key("direction").says("instead: any length > 0"));
    table.rules.push_back({Kind::exactly_one,
                           {"direction", key},
                           {},
                           {},
                           "give either direction = [..] or " + std::string(key) + " = [\"x\", ..]"});
}

// needed: why one pattern is, at least; empty: none is.
void add_terms(KeyTable& table, const std::string& needed) {
    table.rows.push_back(text_key("pattern").says("name of the pattern that it follows"));
    table.rows.push_back(number_key("coefficient").otherwise("1").says("factor on the pattern"));
    table.rows.push_back(tables_key("terms", "term").entries(1, 0).says("instead: several patterns"));
    table.rules.push_back(
        {Kind::excludes, {"terms"}, {"pattern", "coefficient"}, {}, "give either terms or pattern and coefficient"});
    if (!needed.empty()) table.rules.push_back({Kind::at_least_one, {"pattern", "terms"}, {}, {}, needed});
    if (needed.empty())
        table.rules.push_back({Kind::needs, {"coefficient"}, {"pattern"}, {}, "is missing: a pattern is expected"});
}

void add_mean(KeyTable& table) {
    table.rows.push_back(flag_key("mean").in_mesh().says("the weighted mean over the faces of the set"));
    table.rules.push_back(
        {Kind::needs, {"mean"}, {"set"}, {}, "is for a set of faces (a patch has it by itself)", Scenes::mesh});
}

// Supports and loads hold all the time unless these keys say otherwise.
void add_times(KeyTable& table) {
    table.rows.push_back(number_key("from")
                             .otherwise("the first instant")
                             .says("time from which on it holds, from where it finds the nodes"));
    table.rows.push_back(
        number_key("reached").says("time at which the nodes have come to the displacement given here; without it, that "
                                   "counts from where they were"));
    table.rows.push_back(number_key("until").otherwise("the last instant").says("time up to which it holds"));
    table.rows.push_back(number_key("released")
                             .otherwise("the instant after `until`")
                             .says("time at which the force that it leaves behind has fallen to zero"));
    table.rules.push_back({Kind::needs, {"reached"}, {"from"}, {}, "is for a support that begins: from is missing"});
    table.rules.push_back({Kind::needs, {"released"}, {"until"}, {}, "is for a support that ends: until is missing"});
}

KeyTable pattern_table() {
    KeyTable table{"pattern", "a factor that follows a table of times", {}, {}};
    table.rows = {
        text_key("name").need().says("letters, digits, '_' and '-'"),
        numbers_key("times").need().says("strictly increasing"),
        numbers_key("values").need().says("as many; linear between the times"),
    };
    return table;
}

KeyTable support_table() {
    KeyTable table{"support", "displacements held at zero", {}, {}};
    add_places(table, any_place);
    add_direction(table, "fix");
    add_mean(table);
    add_times(table);
    return table;
}

KeyTable load_table() {
    KeyTable table{"load", "prescribed displacements", {}, {}};
    add_places(table, any_place);
    add_direction(table, "component");
    add_terms(table, "is missing: a pattern is expected");
    add_mean(table);
    add_times(table);
    return table;
}

KeyTable force_table() {
    KeyTable table{"force", "dead forces", {}, {}};
    add_places(table, {"point", "patch", "set", "control"});
    table.rows.push_back(vector_key("force").says("the total force at factor 1"));
    table.rows.push_back(vector_key("traction").says("force per length (2D) or area"));
    table.rows.push_back(number_key("pressure").in_mesh().says("on the faces of a set, against their outward normals"));
    table.rows.push_back(text_key("pattern").need().says("name of the pattern that it follows"));
    table.rules.push_back(
        {Kind::exactly_one, {"force", "traction", "pressure"}, {}, {}, "give one of force, traction and pressure"});
    table.rules.push_back({Kind::excludes,
                           {"traction", "pressure"},
                           {"point", "control"},
                           {},
                           "is force per area: a single node has none, give force"});
    table.rules.push_back(
        {Kind::needs, {"pressure"}, {"set"}, {}, "is for a set of faces; on a patch give traction", Scenes::mesh});
    return table;
}

KeyTable strain_table(const std::string& name, const std::string& meaning) {
    KeyTable table{name, meaning, {}, {}};
    table.rows = {
        text_key("pattern").need().says("name of the pattern that it follows"),
        texts_key("layers").in_layers().otherwise("all").says("names of layers"),
        texts_key("bodies").in_mesh().otherwise("all").says("names of bodies, * matches any characters"),
    };
    return table;
}

KeyTable eigenstrain_table() {
    KeyTable table = strain_table("eigenstrain", "a prescribed strain, times the factor of a pattern");
    table.rows.push_back(numbers_key("strain").entries_either(3, 6).need().says(
        "[xx, yy, zz] or [xx, yy, zz, 2xy, 2yz, 2zx], material axes"));
    return table;
}

KeyTable control_table() {
    KeyTable table{"control", "a node of no body, to which other tables refer", {}, {}};
    table.rows = {
        text_key("name").need().says("by which other tables refer to it"),
        vector_key("at")
            .otherwise("the lower corner of the mesh")
            .says("coordinates: the point about which what is coupled to it rotates, and for pictures"),
    };
    return table;
}

KeyTable equation_side_table() {
    KeyTable table{"equation_side", "a term of an equation", {}, {}};
    add_places(table, {"point", "patch", "set", "control"});
    add_direction(table, "component");
    table.rows.push_back(number_key("coefficient").otherwise("1").says("factor on the displacement"));
    return table;
}

KeyTable equation_table() {
    KeyTable table{"equation", "a linear equation between displacements", {}, {}};
    table.rows = {text_key("name").says("free text"),
                  tables_key("left", "equation_side").entries(1, 0).need().says("the terms of its left-hand side")};
    add_terms(table, "");
    return table;
}

KeyTable coupling_table() {
    KeyTable table{"coupling", "nodes that move with a control node", {}, {}};
    add_places(table, {"point", "box", "set", "body"});
    add_direction(table, "component");
    table.rows.push_back(text_key("control").need().says("name of the control node"));
    table.rows.push_back(text_key("rotation").says("name of a control node whose components are the rotation"));
    return table;
}

KeyTable obstacle_table() {
    KeyTable table{"obstacle", "a rigid plane that moves with a control node", {}, {}};
    add_places(table, {"patch", "set"});
    table.rows.push_back(text_key("control").need().says("name of the control node"));
    return table;
}

KeyTable cell_component_table(const std::string& name, const std::string& meaning, const std::string& pattern_needed) {
    KeyTable table{name, meaning, {}, {}};
    table.rows = {choice_key("component", {"xx", "yy", "zz", "xy", "yz", "zx"}).need().says("shears are doubled")};
    add_terms(table, pattern_needed);
    return table;
}

KeyTable cell_table() {
    KeyTable table{"cell", "a periodic cell under average strain or stress", {}, {}};
    KeyRow periods = vector_key("periods").says("vectors by which the mesh repeats");
    periods.kind = KeyKind::points;
    table.rows = {
        periods.each(2, 3).entries(1, 3),
        number_key("tolerance", pairing_tolerance)
            .otherwise("1e-6")
            .says("largest deviation of two partners, divided by the largest extent of the cells"),
        tables_key("strain", "cell_strain").says("components of the average strain"),
        tables_key("stress", "cell_stress").says("components of the average stress"),
    };
    return table;
}

KeyTable box_table() {
    KeyTable table{"box", "a closed box", {}, {}};
    table.rows = {vector_key("lower").need().says("corner"), vector_key("upper").need().says("corner")};
    return table;
}

KeyTable patch_table() {
    KeyTable table{"patch", "a part of the boundary, which acts through one weighted mean", {}, {}};
    KeyRow faces = choice_key("face", {"+x", "-x", "+y", "-y", "+z", "-z"});
    table.rows = {
        vector_key("centre").need().says("coordinates"),
        numbers_key("length", positive)
            .entries(1, 2)
            .or_alone()
            .need()
            .says("extent; 3D: [l1, l2] or one number for both"),
        faces.need().says("outward normal"),
    };
    return table;
}

KeyTable term_table() {
    KeyTable table{"term", "a pattern and its coefficient", {}, {}};
    table.rows = {text_key("pattern").need().says("name of a pattern"),
                  number_key("coefficient").otherwise("1").says("factor on the pattern")};
    return table;
}

}  // namespace

std::vector<KeyTable> action_tables() {
    return {pattern_table(),
            support_table(),
            load_table(),
            force_table(),
            strain_table("thermal", "a change of temperature, the factor of a pattern"),
            eigenstrain_table(),
            control_table(),
            equation_table(),
            equation_side_table(),
            coupling_table(),
            obstacle_table(),
            cell_table(),
            cell_component_table("cell_strain", "a component of the average strain", ""),
            cell_component_table("cell_stress", "a component of the average stress",
                                 "is needed: a stress that is not given is zero"),
            box_table(),
            patch_table(),
            term_table()};
}

}  // namespace cli
