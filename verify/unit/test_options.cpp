// SPDX-License-Identifier: BSD-3-Clause
// The table of options from inside: hashes stay as they were, new rows do not change them, aliases and alternative
// words.
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <type_traits>

#include "base/archive.hpp"
#include "base/error.hpp"
#include "check.hpp"
#include "delam/delam.h"
#include "refused.hpp"
#include "scene/options.hpp"

using namespace delam;

namespace {

constexpr std::uint64_t seed = checksum_start;

// The end of a range, or a number well inside if the end is excluded.
double allowed_end(const Bound& end, const Bound& other) {
    return end.included ? end.number : 0.5 * (end.number + other.number);
}

// The message about a value; "": it is accepted.
template <class Value>
std::string refusal(const std::string& key, const Value& value) {
    Options options;
    return unit::refusal(DELAM_ERROR_ARGUMENT, [&] {
        if constexpr (std::is_same_v<Value, double>)
            options.set_number(key, value);
        else
            options.set_text(key, value);
    });
}

}  // namespace

// Saved states and results identify their scene by this hash. Both numbers were computed before the table existed.
TEST(hashes_stay_as_they_were) {
    Options options;
    options.set_text("mixity_rule", "frozen");  // its default at that time
    ck_assert_uint_eq(hash(options, seed), 0x17c7745f32b9ddd7u);
    const std::pair<const char*, const char*> words[] = {
        {"solution", "energetic"},     {"backtracking", "off"},    {"step_control", "adaptive"},
        {"minimisation", "alternate"}, {"reduction", "feti"},      {"contact", "always"},
        {"mixity", "always"},          {"gluing", "redundant"},    {"mixity_rule", "converged"},
        {"preconditioner", "lumped"},  {"scaling", "multiplicity"}};
    const std::pair<const char*, double> numbers[] = {{"backtracking_limit", 1.0},
                                                      {"backtracking_depth", 2.0},
                                                      {"search_limit", 3.0},
                                                      {"search_tolerance", 0.04},
                                                      {"step_tolerance", 0.05},
                                                      {"mixity_step_tolerance", 0.06},
                                                      {"smallest_step", 0.07},
                                                      {"jump_tolerance", 0.08},
                                                      {"jump_size", 9.0},
                                                      {"damage_tolerance", 0.10},
                                                      {"minimisation_limit", 11.0},
                                                      {"backtracking_tolerance", 0.12},
                                                      {"contact_limit", 13.0},
                                                      {"subdomains", 14.0},
                                                      {"linear_tolerance", 0.15},
                                                      {"linear_limit", 16.0},
                                                      {"threads", 17.0}};
    for (const auto& [key, word] : words) options.set_text(key, word);
    for (const auto& [key, number] : numbers) options.set_number(key, number);
    ck_assert_uint_eq(hash(options, seed), 0x15cdb0642e428c44u);
}

// A later row enters the hash if it is set; a row that affects no digit never does.
TEST(new_rows_leave_old_hashes_alone) {
    const auto whole = option_table();
    std::vector<Option> table(whole.begin(), whole.end());
    const auto late =
        std::find_if(table.begin(), table.end(), [](const Option& o) { return o.key == std::string("threads"); });
    ck_assert(late != table.end() && late->hashed == Hashed::never);
    Options options;
    const std::uint64_t before = hash(options, seed, table);
    late->hashed = Hashed::where_set;
    ck_assert_uint_eq(hash(options, seed, table), before);
    options.threads = 2;
    const std::uint64_t two = hash(options, seed, table);
    options.threads = 3;
    const std::uint64_t three = hash(options, seed, table);
    ck_assert(two != before && three != before && two != three);
    // The key enters as well: the same value for another option is another scene.
    late->key = "strands";
    ck_assert_uint_ne(hash(options, seed, table), three);
    late->hashed = Hashed::never;
    ck_assert_uint_eq(hash(options, seed, table), before);
}

TEST(ranges_end_where_they_say) {
    for (const Option& row : option_table()) {
        if (row.type == std::string("text")) continue;
        ck_assert(row.lower.number < row.upper.number);
        ck_assert(refusal(row.key, allowed_end(row.lower, row.upper)).empty());
        ck_assert(refusal(row.key, allowed_end(row.upper, row.lower)).empty());
        const double width = std::max(1.0, std::abs(row.upper.number)) * 1e-15;
        for (const double bad : {row.lower.included ? row.lower.number - width : row.lower.number,
                                 row.upper.included ? row.upper.number * (1.0 + 1e-15) + 1e-15 : row.upper.number}) {
            const std::string why = refusal(row.key, bad);
            ck_assert_msg(why.find("outside its range: " + row.range) != std::string::npos, "%s = %.17g: '%s'", row.key,
                          bad, why.c_str());
        }
    }
}

TEST(aliases_are_the_same_option) {
    std::set<std::string> names;
    int aliases = 0, other_words = 0;
    for (const Option& row : option_table()) {
        ck_assert_msg(names.insert(row.key).second, "%s stands for two options", row.key);
        if (*row.alias != '\0') {
            ++aliases;
            ck_assert_msg(names.insert(row.alias).second, "%s stands for two options", row.alias);
            ck_assert_msg(row.meaning.find(row.alias) != std::string::npos, "%s is not listed", row.alias);
            ck_assert(Options().value_of(row.alias) == Options().value_of(row.key));
            Options by_key, by_alias;
            if (row.words.empty()) {
                by_key.set_number(row.key, allowed_end(row.upper, row.lower));
                by_alias.set_number(row.alias, allowed_end(row.upper, row.lower));
            } else {
                by_key.set_text(row.key, row.words.back());
                by_alias.set_text(row.alias, row.words.back());
            }
            ck_assert(by_key.value_of(row.key) == by_alias.value_of(row.key));
            ck_assert_uint_ne(hash(by_key, seed), hash(Options(), seed));
            ck_assert_uint_eq(hash(by_key, seed), hash(by_alias, seed));
        }
        for (const auto& [other, word] : row.other_words) {
            ++other_words;
            ck_assert_msg(row.range.find(other) != std::string::npos, "%s is not listed", other.c_str());
            ck_assert_msg(std::find(row.words.begin(), row.words.end(), word) != row.words.end(), "%s is no word of %s",
                          word.c_str(), row.key);
            Options options;
            options.set_text(row.key, row.words.back() == word ? row.words.front() : row.words.back());
            ck_assert(options.value_of(row.key) != word);
            options.set_text(row.key, other);
            ck_assert(options.value_of(row.key) == word);
        }
    }
    ck_assert(aliases > 0 && other_words > 0);
}

TEST(refusals_say_what_and_why) {
    const auto number = [](const char* key, double value) { return refusal(key, value); };
    const auto word = [](const char* key, const char* value) { return refusal(key, std::string(value)); };
    const auto says = [](const std::string& words, const std::string& part) {
        ck_assert_msg(words.find(part) != std::string::npos, "'%s' does not say '%s'", words.c_str(), part.c_str());
    };
    says(number("linear_tolerence", 1e-9), "'linear_tolerence' is not known; known are solution, ");
    says(number("linear_tolerence", 1e-9), "linear_tolerance");
    says(number("", 1e-9), "'' is not known");
    says(word("", "auto"), "'' is not known");
    says(number("contact_limit", 1.5), "option 'contact_limit' = 1.5 must be a whole number");
    says(number("contact_limit", 0.0), "option 'contact_limit' = 0 is outside its range: 1 <= value <= 2^53");
    says(number("solution", 1.0), "option 'solution' is a text (local | energetic), not a number");
    says(word("contact_limit", "7"), "option 'contact_limit' is a number (1 <= value <= 2^53), not a text");
    says(word("solution", "nonsense"), "option 'solution' = 'nonsense' is outside its range: local | energetic");
    says(word("solution", "local | energetic"), "is outside its range");
}
