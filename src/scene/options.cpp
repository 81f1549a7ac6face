// SPDX-License-Identifier: BSD-3-Clause
#include "scene/options.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/error.hpp"
#include "delam/delam.h"

namespace delam {
namespace {

std::vector<std::string_view> parts(std::string_view list, std::string_view between) {
    std::vector<std::string_view> found;
    while (true) {
        const std::size_t end = list.find(between);
        found.push_back(list.substr(0, end));
        if (end == std::string_view::npos) return found;
        list.remove_prefix(end + between.size());
    }
}

using Member = decltype(Option::member);

Option row(const char* type, const char* key, const char* alias, const char* unit, const char* initial, Member member,
           Hashed hashed, const char* meaning) {
    Option made{key, alias, type, unit, initial, member, {}, {}, {}, {}, hashed, {}, meaning};
    if (*alias != '\0') made.meaning += text("; ", alias, ": another key of this option");
    return made;
}

Option number_row(Option made, Bound lower, Bound upper) {
    made.lower = lower;
    made.upper = upper;
    made.range =
        text(lower.words, lower.included ? " <=" : " <", " value ", upper.included ? "<= " : "< ", upper.words);
    return made;
}

// words: "a | b = c" allows a and b, and takes c for b.
Option text_row(Option made, std::string_view words) {
    std::string others;
    for (const std::string_view group : parts(words, " | ")) {
        const std::vector<std::string_view> same = parts(group, " = ");
        made.words.emplace_back(same.front());
        made.range += text(made.range.empty() ? "" : " | ", same.front());
        for (std::size_t i = 1; i < same.size(); ++i) {
            made.other_words.emplace_back(same[i], same.front());
            others += text(" | ", same[i]);
            made.meaning += text("; ", same[i], ": another word for ", same.front());
        }
    }
    made.range += others;
    return made;
}

// A number of a row is both a value and, as it is written there, text for people.
#define FROM(number) (Bound{number, #number, true})
#define TO(number) (Bound{number, #number, true})
#define ABOVE(number) (Bound{number, #number, false})
#define BELOW(number) (Bound{number, #number, false})
#define LARGEST (Bound{9007199254740992.0, "2^53", true})
#define DELAM_REAL(key, alias, unit, initial, lower, upper, hashed, meaning) \
    number_row(row("real", #key, alias, unit, #initial, &Options::key, Hashed::hashed, meaning), lower, upper),
#define DELAM_WHOLE(key, alias, unit, initial, lower, upper, hashed, meaning) \
    number_row(row("integer", #key, alias, unit, #initial, &Options::key, Hashed::hashed, meaning), lower, upper),
#define DELAM_TEXT(key, alias, initial, words, hashed, meaning) \
    text_row(row("text", #key, alias, "-", #initial, &Options::key, Hashed::hashed, meaning), words),

std::vector<Option> read_rows() {
    return {
#include "scene/options.inc"
    };
}

#undef FROM
#undef TO
#undef ABOVE
#undef BELOW
#undef LARGEST

const Option& find(const std::string& key) {
    const std::span<const Option> table = option_table();
    for (const Option& row : table) {
        if (key == row.key || (key == row.alias && !key.empty())) return row;
    }
    std::string known;
    for (const Option& row : table) known += text(known.empty() ? "" : ", ", row.key);
    fail(DELAM_ERROR_ARGUMENT, "option '", key, "' is not known; known are ", known);
}

bool allows(const Option& row, double value) {
    const bool above = row.lower.included ? value >= row.lower.number : value > row.lower.number;
    const bool below = row.upper.included ? value <= row.upper.number : value < row.upper.number;
    return above && below;  // NaN is neither
}

[[noreturn]] void refuse(const Option& row, const std::string& value) {
    fail(DELAM_ERROR_ARGUMENT, "option '", row.key, "' = ", value, " is outside its range: ", row.range);
}

}  // namespace

void Options::set_number(const std::string& key, double value) {
    const Option& row = find(key);
    if (std::holds_alternative<std::string Options::*>(row.member))
        fail(DELAM_ERROR_ARGUMENT, "option '", key, "' is a text (", row.range, "), not a number");
    if (!allows(row, value)) refuse(row, text(value));
    if (const auto* real = std::get_if<double Options::*>(&row.member)) {
        this->*(*real) = value;
    } else {
        if (value != std::floor(value))
            fail(DELAM_ERROR_ARGUMENT, "option '", key, "' = ", value, " must be a whole number");
        this->*std::get<std::int64_t Options::*>(row.member) = static_cast<std::int64_t>(value);
    }
}

void Options::set_text(const std::string& key, const std::string& value) {
    const Option& row = find(key);
    const auto* member = std::get_if<std::string Options::*>(&row.member);
    if (member == nullptr) fail(DELAM_ERROR_ARGUMENT, "option '", key, "' is a number (", row.range, "), not a text");
    std::string word = value;
    for (const auto& [other, same] : row.other_words) {
        if (value == other) word = same;
    }
    if (std::find(row.words.begin(), row.words.end(), word) == row.words.end()) refuse(row, "'" + value + "'");
    this->*(*member) = std::move(word);
}

std::string Options::value_of(const std::string& key) const {
    return std::visit([&](const auto member) { return text(this->*member); }, find(key).member);
}

std::span<const Option> option_table() {
    static const std::vector<Option> table = read_rows();
    return table;
}

}  // namespace delam
