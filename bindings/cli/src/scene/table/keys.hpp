// SPDX-License-Identifier: BSD-3-Clause
// The keys of a scene file, one row each: what the reader allows, and what the JSON Schema and the manual page list.
// Laws and [solver] get further rows from the library (scene_keys.cpp).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "text/range.hpp"

namespace cli {

enum class KeyKind {
    number,
    whole,
    flag,
    text,    // any
    choice,  // one of `choices`
    numbers,
    wholes,
    texts,   // each one of `choices` if there are any
    points,  // a list of lists of numbers
    table,
    tables,
};

// The scenes that have a key.
enum class Scenes { any, layers, mesh };

// Allowed number of entries of a list; the reader knows more where this depends on other keys.
struct Count {
    std::size_t least = 1;
    std::size_t most = 0;  // 0: without limit
    bool between = true;   // also those between
};

// The row of a key, written as a sentence: number("h", positive).says("edge length of a cell").
struct KeyRow {
    std::string key;
    KeyKind kind = KeyKind::text;
    const Range* range = &any_number;
    std::int64_t least = 0, most = INT64_MAX;  // of whole numbers
    Count count{};
    Count inner{};        // of each entry of `points`
    bool or_one = false;  // instead of a list: one entry alone
    bool needed = false;
    Scenes scenes = Scenes::any;
    std::vector<std::string> choices;
    std::string initial;  // default as TOML; in words if it depends on other keys
    std::string content;  // the table that it holds
    std::string meaning;
    std::vector<std::string> synonyms;  // that people write for it; a message then names the key

    KeyRow& need() { return needed = true, *this; }
    KeyRow& in_layers() { return scenes = Scenes::layers, *this; }
    KeyRow& in_mesh() { return scenes = Scenes::mesh, *this; }
    KeyRow& entries(std::size_t fewest, std::size_t largest) { return count = {fewest, largest}, *this; }
    KeyRow& entries_either(std::size_t fewer, std::size_t more) { return count = {fewer, more, false}, *this; }
    KeyRow& each(std::size_t fewest, std::size_t largest) { return inner = {fewest, largest}, *this; }
    KeyRow& or_alone() { return or_one = true, *this; }
    KeyRow& otherwise(std::string_view text) { return initial = text, *this; }
    KeyRow& says(std::string_view text) { return meaning = text, *this; }
    KeyRow& written(std::vector<std::string> others) { return synonyms = std::move(others), *this; }
};

// A condition on the keys of one table. A key counts as given unless it is missing or false.
struct KeyRule {
    enum Kind {
        exactly_one,   // of `keys`
        at_most_one,   // of `keys`
        at_least_one,  // of `keys`
        needs,         // any of `keys`: one of `others` as well
        excludes,      // any of `keys`: none of `others`
        only_where,    // any of `keys`: others[0] has one of `values`
        needed_where,  // others[0] has one of `values`: one of `keys`
    };
    Kind kind;
    std::vector<std::string> keys;
    std::vector<std::string> others;
    std::vector<std::string> values;
    std::string message;  // at the key concerned; empty: the reader finds it later, with more to say
    Scenes scenes = Scenes::any;
};

struct KeyTable {
    std::string name;  // "geometry", "patch"
    std::string meaning;
    std::vector<KeyRow> rows;
    std::vector<KeyRule> rules;

    [[nodiscard]] const KeyRow* row(std::string_view key) const;
};

}  // namespace cli
