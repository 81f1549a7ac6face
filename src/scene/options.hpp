// SPDX-License-Identifier: BSD-3-Clause
// The options of a problem: their values, and the table that describes them. Both come from the rows of options.inc.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "scene/limits.hpp"

namespace delam {

// A member for each row, with its default: options.threads, options.solution, ...
struct Options {
#define DELAM_REAL(key, alias, unit, initial, lower, upper, hashed, meaning) double key = initial;
#define DELAM_WHOLE(key, alias, unit, initial, lower, upper, hashed, meaning) std::int64_t key = initial;
#define DELAM_TEXT(key, alias, initial, words, hashed, meaning) std::string key = #initial;
#include "scene/options.inc"

    Limits limits{};  // no options: for tests

    // Both take the key or its alias, and throw Error(DELAM_ERROR_ARGUMENT) for what its row does not allow.
    void set_number(const std::string& key, double value);
    void set_text(const std::string& key, const std::string& value);
    // Returns the value as people write it.
    std::string value_of(const std::string& key) const;
};

// The ways in which an option enters the hash of a scene.
enum class Hashed {
    always,     // its value, in the order of the rows
    where_set,  // key and value where it is not its first default: scenes hash as they did before it came
    never       // results do not depend on it
};

// An end of a range: the number, as people write it, and whether the range includes it.
struct Bound {
    double number = 0.0;
    const char* words = "";
    bool included = true;
};

// A row of the table.
struct Option {
    const char* key;
    const char* alias;    // a second key; "": none
    const char* type;     // real | integer | text
    const char* unit;     // -: none
    const char* initial;  // the default, as people write it
    std::variant<double Options::*, std::int64_t Options::*, std::string Options::*> member;
    Bound lower, upper;              // of a number
    std::vector<std::string> words;  // of a text: what it may be
    // words that are taken for one of these: (other, word)
    std::vector<std::pair<std::string, std::string>> other_words;
    Hashed hashed;
    std::string range;    // bounds or words, as people read them
    std::string meaning;  // with the alias and the other words
};
std::span<const Option> option_table();

// FNV-1a over the options, going on from `seed`.
std::uint64_t hash(const Options& options, std::uint64_t seed, std::span<const Option> table = option_table());

}  // namespace delam
