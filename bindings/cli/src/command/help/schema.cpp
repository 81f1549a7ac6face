// SPDX-License-Identifier: BSD-3-Clause
#include "command/help/schema.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "scene/table/scene_keys.hpp"

namespace cli {

namespace {

using SchemaJson = nlohmann::ordered_json;

// One definition holds the keys of all scenes, for editors that offer keys; where scenes with and without [mesh]
// differ, two more hold what each allows.
std::string definition_name(const KeyTable& table, Scenes scenes) {
    const char* suffix = scenes == Scenes::layers ? "-of-layers" : scenes == Scenes::mesh ? "-of-mesh" : "";
    return table.name + suffix;
}

bool differs(const KeyTable& table) {
    return std::any_of(table.rows.begin(), table.rows.end(),
                       [](const KeyRow& row) {
                           return row.scenes != Scenes::any ||
                                  (!row.content.empty() && differs(scene_table(row.content)));
                       }) ||
           std::any_of(table.rules.begin(), table.rules.end(),
                       [](const KeyRule& rule) { return rule.scenes != Scenes::any; });
}

SchemaJson reference(const std::string& table, Scenes scenes) {
    const KeyTable& content = scene_table(table);
    return {{"$ref", "#/definitions/" + definition_name(content, differs(content) ? scenes : Scenes::any)}};
}

SchemaJson number_schema(const Range& range) {
    SchemaJson out{{"type", "number"}};
    if (std::isfinite(range.lower)) {
        out["minimum"] = range.lower;
        if (range.lower_open) out["exclusiveMinimum"] = true;
    }
    if (std::isfinite(range.upper)) {
        out["maximum"] = range.upper;
        if (range.upper_open) out["exclusiveMaximum"] = true;
    }
    return out;
}

SchemaJson whole_schema(const KeyRow& row) {
    SchemaJson out{{"type", "integer"}, {"minimum", row.least}};
    if (row.most != INT64_MAX) out["maximum"] = row.most;
    return out;
}

SchemaJson text_schema(const KeyRow& row) {
    SchemaJson out{{"type", "string"}};
    if (!row.choices.empty()) out["enum"] = row.choices;
    return out;
}

SchemaJson list_schema(const SchemaJson& items, const Count& count) {
    SchemaJson out{{"type", "array"}, {"items", items}};
    if (count.least > 0) out["minItems"] = count.least;
    if (count.most > 0) out["maxItems"] = count.most;
    if (count.between) return out;
    SchemaJson fewer = out, more = out;
    fewer["maxItems"] = count.least;
    more["minItems"] = count.most;
    return {{"anyOf", {fewer, more}}};
}

SchemaJson value_schema(const KeyRow& row, Scenes scenes) {
    SchemaJson one;
    switch (row.kind) {
        case KeyKind::number:
            return number_schema(*row.range);
        case KeyKind::whole:
            return whole_schema(row);
        case KeyKind::flag:
            return {{"type", "boolean"}};
        case KeyKind::text:
        case KeyKind::choice:
            return text_schema(row);
        case KeyKind::texts:
            return list_schema(text_schema(row), row.count);
        case KeyKind::points:
            return list_schema(list_schema(number_schema(*row.range), row.inner), row.count);
        case KeyKind::table:
            return reference(row.content, scenes);
        case KeyKind::tables:
            return list_schema(reference(row.content, scenes), row.count);
        case KeyKind::numbers:
            one = number_schema(*row.range);
            break;
        case KeyKind::wholes:
            one = whole_schema(row);
            break;
    }
    const SchemaJson list = list_schema(one, row.count);
    return row.or_one ? SchemaJson{{"anyOf", {one, list}}} : list;
}

// The schema of a key, for people as well.
SchemaJson property_of(const KeyRow& row, Scenes scenes) {
    const SchemaJson initial = SchemaJson::parse(row.initial, nullptr, false);
    const bool constant = !row.initial.empty() && !initial.is_discarded();
    std::string words = row.meaning;
    if (!row.initial.empty() && !constant) words += fmt::format(" (default: {})", row.initial);
    const SchemaJson value = value_schema(row, scenes);
    // Beside a reference, other words do not count.
    SchemaJson out = value.contains("$ref") ? SchemaJson{{"allOf", {value}}} : value;
    out["description"] = words;
    if (constant) out["default"] = initial;
    return out;
}

SchemaJson given_schema(const KeyTable& table, const std::string& key) {
    SchemaJson out{{"required", {key}}};
    const KeyRow* row = table.row(key);
    if (row != nullptr && row->kind == KeyKind::flag) out["properties"] = {{key, {{"enum", {true}}}}};
    return out;
}

SchemaJson any_given(const KeyTable& table, const std::vector<std::string>& keys) {
    SchemaJson list = SchemaJson::array();
    for (const std::string& key : keys) list.push_back(given_schema(table, key));
    return {{"anyOf", list}};
}

SchemaJson none_given(const KeyTable& table, const std::vector<std::string>& keys) {
    return {{"not", any_given(table, keys)}};
}

SchemaJson value_is_one_of(const KeyTable& table, const std::string& key, const std::vector<std::string>& values) {
    const KeyRow& row = *table.row(key);
    SchemaJson list = SchemaJson::array();
    bool by_default = false;
    for (const std::string& value : values) {
        by_default = by_default || row.initial == "\"" + value + "\"";
        list.push_back(row.kind == KeyKind::whole ? SchemaJson(std::stoll(value)) : SchemaJson(value));
    }
    SchemaJson out{{"properties", {{key, {{"enum", list}}}}}};
    if (!by_default) out["required"] = {key};
    return out;
}

SchemaJson rule_schema(const KeyTable& table, const KeyRule& rule) {
    SchemaJson one_each = SchemaJson::array(), pairs = SchemaJson::array();
    for (const std::string& key : rule.keys) one_each.push_back(given_schema(table, key));
    switch (rule.kind) {
        case KeyRule::exactly_one:
            return {{"oneOf", one_each}};
        case KeyRule::at_most_one:
            for (std::size_t i = 0; i < rule.keys.size(); ++i)
                for (std::size_t j = 0; j < i; ++j)
                    pairs.push_back(
                        {{"allOf", {given_schema(table, rule.keys[i]), given_schema(table, rule.keys[j])}}});
            return {{"not", {{"anyOf", pairs}}}};
        case KeyRule::at_least_one:
            return {{"anyOf", one_each}};
        case KeyRule::needs:
            return {{"anyOf", {none_given(table, rule.keys), any_given(table, rule.others)}}};
        case KeyRule::excludes:
            return {{"anyOf", {none_given(table, rule.keys), none_given(table, rule.others)}}};
        case KeyRule::only_where:
            return {
                {"anyOf", {none_given(table, rule.keys), value_is_one_of(table, rule.others.front(), rule.values)}}};
        case KeyRule::needed_where:
            return {
                {"anyOf",
                 {{{"not", value_is_one_of(table, rule.others.front(), rule.values)}}, any_given(table, rule.keys)}}};
    }
    return {};
}

SchemaJson table_schema(const KeyTable& table, Scenes scenes) {
    SchemaJson properties = SchemaJson::object(), required = SchemaJson::array(), rules = SchemaJson::array();
    for (const KeyRow& row : table.rows) {
        if (scenes != Scenes::any && row.scenes != Scenes::any && row.scenes != scenes) continue;
        properties[row.key] = property_of(row, scenes);
        if (row.needed && (row.scenes == Scenes::any || row.scenes == scenes)) required.push_back(row.key);
    }
    for (const KeyRule& rule : table.rules) {
        if (rule.scenes != Scenes::any && rule.scenes != scenes) continue;
        SchemaJson entry = rule_schema(table, rule);
        if (!rule.message.empty()) entry["description"] = rule.message;
        rules.push_back(entry);
    }
    SchemaJson out{{"type", "object"}, {"description", table.meaning}, {"properties", properties}};
    out["additionalProperties"] = false;
    if (!required.empty()) out["required"] = required;
    if (!rules.empty()) out["allOf"] = rules;
    return out;
}

// Returns what a scene with one of the two tables allows beyond the definitions of all scenes.
SchemaJson narrowed(const KeyTable& root, Scenes scenes) {
    SchemaJson properties = SchemaJson::object();
    for (const KeyRow& row : root.rows) {
        if (row.scenes != Scenes::any && row.scenes != scenes)
            properties[row.key] = {{"not", SchemaJson::object()}};
        else if (!row.content.empty() && differs(scene_table(row.content)))
            properties[row.key] = value_schema(row, scenes);
    }
    return {{"properties", properties}};
}

}  // namespace

std::string scene_schema() {
    const KeyTable& root = scene_tables().front();
    SchemaJson out{{"$schema", "http://json-schema.org/draft-04/schema#"}, {"title", "Scene of libdelam, schema 1"}};
    const SchemaJson body = table_schema(root, Scenes::any);
    for (const auto& [key, value] : body.items()) out[key] = value;
    out["dependencies"] = {{"geometry", narrowed(root, Scenes::layers)}, {"mesh", narrowed(root, Scenes::mesh)}};
    SchemaJson& definitions = out["definitions"];
    for (const KeyTable& table : scene_tables()) {
        if (table.name == root.name) continue;
        definitions[table.name] = table_schema(table, Scenes::any);
        if (!differs(table)) continue;
        for (const Scenes scenes : {Scenes::layers, Scenes::mesh})
            definitions[definition_name(table, scenes)] = table_schema(table, scenes);
    }
    return out.dump(1) + "\n";
}

}  // namespace cli
