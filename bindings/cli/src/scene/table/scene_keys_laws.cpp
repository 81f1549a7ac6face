// SPDX-License-Identifier: BSD-3-Clause
// Keys of [[laws]], [[interfaces]] and [solver]. The library lists the parameters of laws and the options.
#include <algorithm>
#include <limits>
#include <list>
#include <map>

#include <fmt/format.h>

#include "delam/delam.h"
#include "scene/table/scene_keys.hpp"

namespace cli {

namespace {

// Ranges live as long as the program, for the rows point to them.
const Range& kept(const Range& range) {
    static std::list<Range> ranges;
    return ranges.emplace_back(range);
}

// "local | energetic" or "power, benzeggagh-kenane" as a list.
std::vector<std::string> words_of(const std::string& text) {
    std::vector<std::string> out(1);
    for (const char c : text) {
        if (c == '|' || c == ',') out.emplace_back();
        if (c != '|' && c != ',' && c != ' ') out.back() += c;
    }
    return out;
}

bool is_word(const std::string& text) {
    return !text.empty() && text.find(' ') == std::string::npos &&
           std::isdigit(static_cast<unsigned char>(text.front())) == 0;
}

struct LawKinds {
    std::vector<std::string> all;                            // that a scene can name: without that of callbacks
    std::vector<std::string> order;                          // of the parameters
    std::map<std::string, KeyRow> rows;                      // by parameter
    std::map<std::string, std::vector<std::string>> kinds;   // that have it
    std::map<std::string, std::vector<std::string>> needed;  // that need it
};

void add_parameters(LawKinds& laws, const std::string& kind) {
    for (std::int64_t i = 0; i < delam_law_parameter_count(kind.c_str()); ++i) {
        const char *key = "", *type = "", *unit = "", *initial = "", *range = "", *meaning = "";
        delam_law_parameter_info(kind.c_str(), i, &key, &type, &unit, &initial, &range, &meaning);
        const std::string name = key, what = type;
        if (!laws.rows.contains(name)) {
            double lower = 0, upper = 0;
            std::int32_t lower_open = 0, upper_open = 0;
            delam_law_parameter_bounds(kind.c_str(), i, &lower, &upper, &lower_open, &upper_open);
            // The words of a table are about all of it, not about each number.
            static std::list<std::string> intervals;
            if (what == "table")
                range = intervals
                            .emplace_back(fmt::format("in {}{:g}, {:g}{}", lower_open != 0 ? '(' : '[', lower, upper,
                                                      upper_open != 0 ? ')' : ']'))
                            .c_str();
            KeyRow row = what == "text"
                             ? choice_key(key, words_of(range))
                             : number_key(key, kept({lower, upper, lower_open != 0, upper_open != 0, range}));
            if (what == "table") row.kind = KeyKind::points;
            if (what == "table") row.entries(2, 0).each(2, 2);
            row.otherwise(is_word(initial) ? "\"" + std::string(initial) + "\"" : initial).says(meaning);
            laws.order.push_back(name);
            laws.rows.emplace(name, std::move(row));
        }
        laws.kinds[name].push_back(kind);
        if (std::string(initial).empty()) laws.needed[name].push_back(kind);
    }
}

LawKinds law_kinds() {
    LawKinds laws;
    for (std::int64_t i = 0; i < delam_law_kind_count(); ++i) {
        const char* kind = nullptr;
        std::int32_t hosted = 0;
        delam_law_kind_info(i, &kind, nullptr, &hosted);
        if (hosted != 0) continue;
        laws.all.emplace_back(kind);
        add_parameters(laws, kind);
    }
    return laws;
}

KeyTable law_table() {
    const LawKinds laws = law_kinds();
    KeyTable table{"law", "a traction-separation law", {}, {}};
    table.rows = {
        text_key("name").need().says("by which interfaces refer to it"),
        choice_key("kind", laws.all).otherwise("\"piecewise-linear\"").says("how the traction falls after the onset")};
    for (const std::string& key : laws.order) {
        table.rows.push_back(laws.rows.at(key));
        const std::vector<std::string>& kinds = laws.kinds.at(key);
        if (kinds.size() < laws.all.size())
            table.rules.push_back(
                {KeyRule::only_where, {key}, {"kind"}, kinds, fmt::format("is for kind {}", fmt::join(kinds, ", "))});
        // A strength takes the place of an onset.
        std::vector<std::string> keys{key};
        if (const std::size_t end = key.find("_onset"); end != std::string::npos) {
            keys.push_back(key.substr(0, end) + "_strength");
            table.rules.push_back(
                {KeyRule::at_most_one, {keys[1], keys[0]}, {}, {}, "is given instead of " + key + ": give one"});
        }
        const auto needed = laws.needed.find(key);
        if (needed == laws.needed.end()) continue;
        const std::string what = table.rows.back().kind == KeyKind::points ? "a table" : "a number";
        table.rules.push_back({KeyRule::needed_where,
                               keys,
                               {"kind"},
                               needed->second,
                               "is missing: " + what + " is expected, " + std::string(table.rows.back().range->text)});
    }
    return table;
}

KeyTable solver_table() {
    KeyTable table{"solver", "options of the library", {}, {}};
    for (std::int64_t i = 0; i < delam_option_count(); ++i) {
        const char *key = "", *alias = "", *type = "", *initial = "", *range = "", *meaning = "";
        delam_option_info(i, &key, &type, nullptr, &initial, &range, &meaning);
        delam_option_alias(i, &alias);
        double lower = -std::numeric_limits<double>::infinity(), upper = -lower;
        std::int32_t lower_open = 1, upper_open = 1;
        const bool word = std::string(type) == "text";
        if (!word) delam_option_bounds(i, &lower, &upper, &lower_open, &upper_open);
        KeyRow row = word ? choice_key(key, words_of(range))
                          : number_key(key, kept({lower, upper, lower_open != 0, upper_open != 0, range}));
        if (std::string(type) == "integer") {
            constexpr double exact = 9007199254740992.0;  // the library takes numbers as doubles
            row = whole_key(key, static_cast<std::int64_t>(lower),
                            upper < exact ? static_cast<std::int64_t>(upper) : INT64_MAX);
        }
        row.otherwise(word ? "\"" + std::string(initial) + "\"" : initial).says(meaning);
        table.rows.push_back(row);
        if (std::string(alias).empty()) continue;
        row.key = alias;
        table.rows.push_back(row.says("the same as " + std::string(key)));
        table.rules.push_back(
            {KeyRule::at_most_one, {alias, key}, {}, {}, "means the same as " + std::string(key) + ": give one"});
    }
    return table;
}

// A part of an interface; it has a value only in `adhesion`.
KeyTable region_table(const std::string& name, bool with_value) {
    KeyTable table{name, "a part of an interface", {}, {}};
    table.rows = {
        number_key("from").in_layers().says("along x"),
        number_key("to").in_layers().says("along x"),
        numbers_key("lower").entries(2, 3).says("corner of a box: 3D; layers: [x, y]"),
        numbers_key("upper").entries(2, 3).says("corner of a box: 3D; layers: [x, y]"),
        text_key("set").in_mesh().says("a set of nodes of the mesh"),
        flag_key("outside").in_mesh().says("the pairs without a face in the set"),
    };
    if (with_value) table.rows.push_back(number_key("value", fraction).need().says("adhesion"));
    using enum KeyRule::Kind;
    table.rules = {
        {excludes,
         {"lower", "upper"},
         {"from", "to"},
         {},
         "give either from and to or lower and upper",
         Scenes::layers},
        {exactly_one,
         {"from", "lower"},
         {},
         {},
         "is missing: from and to are expected, or in 3D lower and upper",
         Scenes::layers},
        {needs, {"from"}, {"to"}, {}, "is missing: a number (finite) is expected", Scenes::layers},
        {needs, {"to"}, {"from"}, {}, "is missing: a number (finite) is expected", Scenes::layers},
        {exactly_one, {"set", "lower"}, {}, {}, "give either set = \"NAME\" or lower and upper", Scenes::mesh},
        {excludes, {"set"}, {"upper"}, {}, "give either set = \"NAME\" or lower and upper", Scenes::mesh},
        {needs, {"outside"}, {"set"}, {}, "is for set = \"NAME\"", Scenes::mesh},
        {needs, {"lower"}, {"upper"}, {}, "is missing: a list of numbers is expected"},
        {needs, {"upper"}, {"lower"}, {}, "is missing: a list of numbers is expected"},
    };
    return table;
}

KeyTable interface_table() {
    KeyTable table{"interface", "two neighbouring layers or bodies, and how they interact", {}, {}};
    table.rows = {
        text_key("lower").need().in_layers().says("name of a layer"),
        text_key("upper").need().in_layers().says("name of the layer directly on it"),
        text_key("a").in_mesh().says("name of a body, * matches any characters"),
        text_key("b").in_mesh().says(
            "name of a body; the jump is its displacement relative to a. The same as a: the seams within this body"),
        flag_key("all").in_mesh().says("instead of a and b: all touching bodies without an entry of their own"),
        text_key("law").says("name of a law"),
        numbers_key("shear_axis")
            .entries(3, 3)
            .otherwise("axis 1 of the material of a (of the lower layer), or x")
            .says("direction of the first tangent, along which the tangential numbers of a law act beside its "
                  "second_tangential ones; 3D"),
        flag_key("bonded").says("instead of a law: bonded perfectly and permanently"),
        flag_key("contact").in_mesh().says("instead of a law: contact without adhesion"),
        flag_key("projected").in_mesh().says("for meshes that do not match: projects b's nodes onto a's faces"),
        choice_key("projection", {"means", "points"})
            .in_mesh()
            .otherwise("means")
            .says(
                "pairs b's nodes with means over a's faces, either mesh may be the finer one; or with points on them"),
        number_key("gap", not_negative).in_mesh().says("largest distance between projected faces"),
        choice_key("initial_gap", {"open", "closed"})
            .in_mesh()
            .otherwise("open with contact = true, closed with a law")
            .says("open: faces that are apart do not adhere, and press only once they meet; closed: they touch from "
                  "the start, whatever their distance"),
        number_key("adjust", not_negative)
            .in_mesh()
            .otherwise("0")
            .says("open: faces up to so far apart, or overlapping by so much, are moved together without strain"),
        number_key("tolerance", pairing_tolerance)
            .in_mesh()
            .otherwise("1e-6")
            .says("largest distance at which two nodes coincide, divided by the shortest edge"),
        choice_key("shared", {"law", "bonded"})
            .in_mesh()
            .otherwise("law")
            .says(
                "nodes that both bodies have in the file: part of the interface with its law, or bonded, whatever the "
                "law of the rest"),
        text_key("cut").in_mesh().says(
            "with the same body as a and b: a set of faces within it, along which its nodes are doubled"),
        tables_key("part", "part")
            .says("the faces for which this entry stands, where others between the same two stand for the rest"),
        tables_key("notch", "notch").says("parts without adhesion from the start"),
        tables_key("adhesion", "adhesion").says("parts with an adhesion of their own"),
    };
    using enum KeyRule::Kind;
    table.rules = {
        {exactly_one, {"law", "bonded"}, {}, {}, "give either law = \"NAME\" or bonded = true", Scenes::layers},
        {exactly_one,
         {"law", "bonded", "contact"},
         {},
         {},
         "give one of law = \"NAME\", bonded = true and contact = true",
         Scenes::mesh},
        {needs, {"notch", "adhesion", "shear_axis"}, {"law"}, {}, "is for interfaces with a law"},
        {at_least_one, {"a", "all"}, {}, {}, "give either a and b or all = true", Scenes::mesh},
        {excludes, {"all"}, {"a", "b"}, {}, "give either a and b or all = true", Scenes::mesh},
        {needs, {"a"}, {"b"}, {}, "is missing: the name of a body is expected", Scenes::mesh},
        {needs,
         {"gap", "projection", "initial_gap", "adjust"},
         {"projected"},
         {},
         "is for projected = true",
         Scenes::mesh},
        {excludes, {"bonded"}, {"initial_gap", "adjust"}, {}, "bonded faces have no gap", Scenes::mesh},
        {excludes, {"shared"}, {"projected"}, {}, "is for meshes that match", Scenes::mesh},
        {excludes, {"projected"}, {"all"}, {}, "needs two bodies by name", Scenes::mesh},
        {excludes, {"cut"}, {"all"}, {}, "is for the same body as a and b", Scenes::mesh},
    };
    return table;
}

KeyTable contact_table() {
    KeyTable table{"contact", "contact wherever outer faces have no interface", {}, {}};
    table.rows = {
        flag_key("general").says("contact of all bodies that touch, and of the two sides of seams within a body"),
        number_key("gap", not_negative)
            .otherwise("0")
            .says("also of faces of two bodies, or of one, up to so far apart"),
    };
    table.rules = {{KeyRule::needs, {"gap"}, {"general"}, {}, "is for general = true"}};
    return table;
}

}  // namespace

std::vector<KeyTable> interface_tables() {
    return {law_table(),
            interface_table(),
            contact_table(),
            region_table("part", false),
            region_table("notch", false),
            region_table("adhesion", true),
            solver_table()};
}

}  // namespace cli
