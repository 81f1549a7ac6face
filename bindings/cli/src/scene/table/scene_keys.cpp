// SPDX-License-Identifier: BSD-3-Clause
#include "scene/table/scene_keys.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "delam/delam.h"

namespace cli {

namespace {

KeyRow row_of(std::string_view key, KeyKind kind) {
    KeyRow row;
    row.key = key;
    row.kind = kind;
    return row;
}

}  // namespace

KeyRow number_key(std::string_view key, const Range& range) {
    KeyRow row = row_of(key, KeyKind::number);
    row.range = &range;
    return row;
}

KeyRow whole_key(std::string_view key, std::int64_t least, std::int64_t most) {
    KeyRow row = row_of(key, KeyKind::whole);
    row.least = least;
    row.most = most;
    return row;
}

KeyRow flag_key(std::string_view key) { return row_of(key, KeyKind::flag).otherwise("false"); }

KeyRow text_key(std::string_view key) { return row_of(key, KeyKind::text); }

KeyRow choice_key(std::string_view key, std::vector<std::string> choices) {
    KeyRow row = row_of(key, KeyKind::choice);
    row.choices = std::move(choices);
    return row;
}

KeyRow numbers_key(std::string_view key, const Range& range) {
    KeyRow row = row_of(key, KeyKind::numbers);
    row.range = &range;
    return row;
}

KeyRow vector_key(std::string_view key) { return numbers_key(key).entries(2, 3); }

KeyRow texts_key(std::string_view key) { return row_of(key, KeyKind::texts); }

KeyRow table_key(std::string_view key, std::string_view content) {
    KeyRow row = row_of(key, KeyKind::table);
    row.content = content;
    return row;
}

KeyRow tables_key(std::string_view key, std::string_view content) {
    KeyRow row = row_of(key, KeyKind::tables);
    row.count = {0, 0};
    row.content = content;
    return row;
}

const KeyRow* KeyTable::row(std::string_view key) const {
    const auto found = std::find_if(rows.begin(), rows.end(), [key](const KeyRow& row) { return row.key == key; });
    return found == rows.end() ? nullptr : &*found;
}

namespace {

KeyTable scene_file() {
    KeyTable table{"scene", "a scene of libdelam", {}, {}};
    table.rows = {
        whole_key("schema", 1, 1).need().says("version of this schema"),
        text_key("title").says("text for pictures and results"),
        table_key("geometry", "geometry").in_layers().says("a block of layers and its mesh"),
        tables_key("layers", "layer").entries(1, 0).in_layers().says("the layers, from the bottom up"),
        table_key("mesh", "mesh").in_mesh().says("a mesh from a file or a generator, instead of geometry and layers"),
        tables_key("bodies", "body").in_mesh().says("materials of the bodies of a mesh"),
        tables_key("materials", "material").need().says("elastic materials"),
        tables_key("laws", "law").says("traction-separation laws"),
        tables_key("interfaces", "interface").says("which neighbouring layers or bodies interact, and how"),
        table_key("contact", "contact").in_mesh().says("contact wherever outer faces have no interface"),
        tables_key("patterns", "pattern").says("factors that follow a table of times"),
        tables_key("supports", "support").says("displacements held at zero"),
        tables_key("loads", "load").says("prescribed displacements"),
        tables_key("forces", "force").says("dead forces"),
        tables_key("thermal", "thermal").says("temperature changes"),
        tables_key("eigenstrains", "eigenstrain").says("other prescribed strains"),
        tables_key("controls", "control").says("control nodes, to which other tables refer"),
        tables_key("equations", "equation").says("linear equations between displacements"),
        tables_key("couplings", "coupling").says("nodes that move with a control node"),
        tables_key("obstacles", "obstacle").says("rigid planes that can push but not pull"),
        table_key("cell", "cell").says("a periodic cell under average strain or stress"),
        table_key("time", "time").need().says("the instants of the load steps"),
        table_key("solver", "solver").says("options of the library"),
        table_key("output", "output").says("what is written"),
        table_key("units", "units").says("names of units, for labels only"),
    };
    table.rules = {
        {KeyRule::at_least_one, {"geometry", "mesh"}, {}, {}, "is missing: a table is expected, or [mesh]"},
        {KeyRule::needs, {"geometry"}, {"layers"}, {}, "is missing: at least one [[layers]] is expected"},
        {KeyRule::needs, {"mesh"}, {"bodies"}, {}, ""},
    };
    return table;
}

KeyTable time_table() {
    KeyTable table{"time", "the instants of the load steps", {}, {}};
    table.rows = {
        number_key("start").otherwise("0").says("instant of the initial state"),
        number_key("end").says("the last instant, after the start"),
        whole_key("steps", 1, 100000000).says("number of equal steps"),
        numbers_key("instants").entries(2, 0).says("instead: instants, strictly increasing, from the initial state on"),
    };
    table.rules = {
        {KeyRule::excludes,
         {"instants"},
         {"start", "end", "steps"},
         {},
         "give either instants or start, end and steps"},
        {KeyRule::exactly_one, {"end", "instants"}, {}, {}, "give either instants or start, end and steps"},
        {KeyRule::needs, {"end"}, {"steps"}, {}, "is missing: a whole number >= 1 is expected"},
    };
    return table;
}

KeyTable output_table() {
    KeyTable table{"output", "what is written", {}, {}};
    KeyRow fields = texts_key("fields")
                        .otherwise("all but mixity and rotation")
                        .says("fields of fields.h5; none: the history alone is written");
    fields.entries(0, 0);
    fields.choices = {"displacement", "stress", "zeta", "jump", "traction", "contact", "mixity", "rotation", "front"};
    table.rows = {
        fields,
        whole_key("every", 1).otherwise("where something happens").says("writes the fields of every n-th step"),
        numbers_key("snapshots")
            .entries(0, 0)
            .otherwise("[0.33, 0.5, 0.66, 1.0, 1.17, 1.33, 1.5, 1.67, 1.83, 2.0]")
            .says("instants of the pictures"),
        number_key("displacement_scale", not_negative)
            .otherwise("5")
            .says("factor on the displacements in the pictures"),
        flag_key("brief").says("leaves out what takes time to examine at the end: errors of the mesh and of small "
                               "rotations, buckling"),
        texts_key("columns").says("further columns of history.csv"),
        texts_key("sensitivities")
            .says(
                "numbers of laws, e.g. laws[0].normal_toughness: the derivatives of the reactions by them, as columns"),
    };
    return table;
}

KeyTable units_table() {
    KeyTable table{"units", "names of units, for labels only", {}, {}};
    table.rows = {
        text_key("length").otherwise("\"\"").says("unit of length, e.g. \"mm\""),
        text_key("force").otherwise("\"\"").says("unit of force, e.g. \"N\""),
        text_key("time").otherwise("\"\"").says("unit of time"),
    };
    return table;
}

std::vector<KeyTable> all_tables() {
    std::vector<KeyTable> tables{scene_file()};
    for (auto* part : {body_tables, mesh_tables, interface_tables, action_tables})
        for (KeyTable& table : part()) tables.push_back(std::move(table));
    tables.push_back(time_table());
    tables.push_back(output_table());
    tables.push_back(units_table());
    return tables;
}

}  // namespace

const std::vector<KeyTable>& scene_tables() {
    static const std::vector<KeyTable> tables = all_tables();
    return tables;
}

const KeyTable& scene_table(std::string_view name) {
    for (const KeyTable& table : scene_tables())
        if (table.name == name) return table;
    throw std::logic_error("the scene file has no table " + std::string(name));
}

}  // namespace cli
