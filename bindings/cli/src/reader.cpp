// SPDX-License-Identifier: BSD-3-Clause
#include "reader.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "setting.hpp"

namespace cli {

namespace {
constexpr double infinite = std::numeric_limits<double>::infinity();

// Levenshtein distance.
std::size_t distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i);
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t change = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = std::exchange(row[j], std::min({change, row[j] + 1, row[j - 1] + 1}));
        }
    }
    return row.back();
}

// toml++ gives no double for integers beyond 2^53 that no double represents exactly; this returns the nearest.
double number_of(const toml::node& node) {
    if (const auto* whole = node.as_integer()) return static_cast<double>(whole->get());
    return node.value_or(std::numeric_limits<double>::quiet_NaN());
}

std::string shown(const toml::node& node) {
    if (const auto* whole = node.as_integer()) return fmt::format("{}", whole->get());
    // 6.0 must not be shown as 6 where an integer is required.
    if (const auto value = node.value<double>();
        value && node.is_floating_point() && *value == std::floor(*value) && std::abs(*value) < 1e15)
        return fmt::format("{:.1f}", *value);
    if (const auto value = node.value<double>(); value && node.is_number()) return fmt::format("{}", *value);
    if (const auto value = node.value<std::string>(); value && node.is_string())
        return fmt::format("\"{}\"", shortened(*value));
    if (const auto value = node.value<bool>(); value && node.is_boolean()) return *value ? "true" : "false";
    if (node.is_array()) return "a list";
    if (node.is_table()) return "a table";
    return "a date or time";
}

std::string joined(const std::string& path, std::string_view key) {
    return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
}

// The place of a value: in the file, or in a setting of the command line.
Place place_of(const toml::node& node, const std::string& file, const std::string& path) {
    const toml::source_path_ptr& source = node.source().path;
    if (source != nullptr && *source == setting_source) return {*source, path, 0};
    return {file, path, static_cast<int>(node.source().begin.line)};
}

double checked_number(const toml::node& node, const Place& where, const Range& range) {
    if (!node.is_number())
        throw SceneFailure(where, fmt::format("{}: a number {} is expected", shown(node), range.text));
    const double value = number_of(node);
    if (!range.contains(value)) throw SceneFailure(where, fmt::format("{} is not allowed: {}", value, range.text));
    return value;
}

// range: in words.
std::int64_t checked_whole(const toml::node& node, const Place& where, const std::string& range) {
    if (!node.is_integer())
        throw SceneFailure(where, fmt::format("{}{}: a whole number{} is expected: {}", shown(node),
                                              node.is_floating_point() ? " has a decimal point" : "",
                                              node.is_floating_point() ? " without one" : "", range));
    return *node.value<std::int64_t>();
}

std::int64_t checked_whole(const toml::node& node, const Place& where, std::int64_t least) {
    checked_whole(node, where, fmt::format(">= {}", least));
    const std::int64_t value = *node.value<std::int64_t>();
    if (value < least) throw SceneFailure(where, fmt::format("{} is not allowed: a whole number >= {}", value, least));
    return value;
}

// words: what is allowed; "" if anything is.
std::string checked_word(const toml::node& node, const Place& where, const std::string& words) {
    if (!node.is_string())
        throw SceneFailure(
            where, fmt::format("{}: a text in quotes is expected{}{}", shown(node), words.empty() ? "" : ": ", words));
    std::string text = *node.value<std::string>();
    if (text.size() > most_text_bytes)
        throw SceneFailure(where, fmt::format("\"{}\" has {} bytes: at most {} are allowed", shortened(text),
                                              text.size(), most_text_bytes));
    return text;
}

std::string checked_text(const toml::node& node, const Place& where) { return checked_word(node, where, ""); }

template <class Value, class Check>
std::vector<Value> checked_list(const toml::node& node, const Place& where, std::size_t count, Check&& check) {
    const toml::array* list = node.as_array();
    const auto expected =
        count > 0 ? fmt::format("a list of {} is expected", count) : std::string("a list is expected");
    if (list == nullptr) throw SceneFailure(where, fmt::format("{}: {}", shown(node), expected));
    if ((count > 0 && list->size() != count) || list->empty())
        throw SceneFailure(
            where, fmt::format("{} entries: {}", list->size(), count > 0 ? expected : "at least one is expected"));
    std::vector<Value> out;
    for (std::size_t i = 0; i < list->size(); ++i) {
        const toml::node& entry = *list->get(i);
        out.push_back(check(entry, place_of(entry, where.file, fmt::format("{}[{}]", where.path, i))));
    }
    return out;
}
}  // namespace

const Range any_number{-infinite, infinite, true, true, "(finite)"};
const Range positive{0, infinite, true, true, "> 0 (finite)"};
const Range not_negative{0, infinite, false, true, ">= 0 (finite)"};
const Range fraction{0, 1, false, false, "in [0, 1]"};
const Range poisson_range{-1, 0.5, true, true, "in (-1, 0.5)"};
const Range pairing_tolerance{0, 0.5, false, true, "in [0, 0.5)"};

bool Range::contains(double value) const {
    if (!std::isfinite(value)) return false;
    return (lower_open ? value > lower : value >= lower) && (upper_open ? value < upper : value <= upper);
}

std::string shortened(const std::string& text) {
    constexpr std::size_t most = 60;
    if (text.size() <= most) return text;
    std::size_t end = most;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;  // within a character of UTF-8
    return text.substr(0, end) + "..";
}

std::string listing(const std::vector<std::string>& names) { return fmt::format("{}", fmt::join(names, ", ")); }

std::string suggestion(std::string_view word, const std::vector<std::string>& known) {
    constexpr std::size_t longest = 80;  // the comparison takes as long as the product of both lengths
    std::vector<std::pair<std::size_t, std::string>> near;
    if (word.size() > longest) return "";
    for (const std::string& name : known) {
        if (name.size() > longest) continue;
        const std::size_t d = distance(word, name);
        const bool part =
            word.size() >= 3 && (name.find(word) != std::string::npos || word.find(name) != std::string_view::npos);
        if (d <= std::max<std::size_t>(2, name.size() / 3) || part) near.emplace_back(d, name);
    }
    if (near.empty()) return "";
    std::stable_sort(near.begin(), near.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::string out = " (did you mean '" + near[0].second + "'";
    for (std::size_t i = 1; i < std::min<std::size_t>(near.size(), 3); ++i) out += " or '" + near[i].second + "'";
    return out + "?)";
}

void Table::only(std::initializer_list<std::string_view> keys) const {
    only(std::vector<std::string>(keys.begin(), keys.end()));
}

void Table::only(const std::vector<std::string>& known) const {
    for (const std::string& key : keys())
        if (std::find(known.begin(), known.end(), key) == known.end())
            fail(key, fmt::format("unknown key{}; allowed here: {}", suggestion(key, known), listing(known)));
}

Place Table::place(std::string_view key) const {
    const toml::node* node = table_->get(key);
    const std::string path = joined(place_.path, key);
    return node != nullptr ? place_of(*node, place_.file, path) : Place{place_.file, path, place_.line};
}

void Table::fail(std::string_view key, const std::string& text) const { throw SceneFailure(place(key), text); }

const toml::node& Table::need(std::string_view key) const {
    const toml::node* node = table_->get(key);
    if (node == nullptr) fail(key, "is missing");
    return *node;
}

double Table::number(std::string_view key, const Range& range) const {
    if (!has(key)) fail(key, fmt::format("is missing: a number {} is expected", range.text));
    return checked_number(need(key), place(key), range);
}

double Table::number(std::string_view key, const Range& range, double otherwise) const {
    return has(key) ? number(key, range) : otherwise;
}

std::int64_t Table::whole(std::string_view key, std::int64_t least) const {
    return checked_whole(need(key), place(key), least);
}

std::int64_t Table::whole(std::string_view key, std::int64_t least, std::int64_t otherwise) const {
    return has(key) ? whole(key, least) : otherwise;
}

std::int64_t Table::whole(std::string_view key, const std::string& range) const {
    return checked_whole(need(key), place(key), range);
}

bool Table::flag(std::string_view key, bool otherwise) const {
    if (!has(key)) return otherwise;
    if (!need(key).is_boolean()) fail(key, fmt::format("{}: true or false is expected", shown(need(key))));
    return *need(key).value<bool>();
}

std::string Table::word(std::string_view key, const std::string& words) const {
    return checked_word(need(key), place(key), words);
}

std::string Table::text(std::string_view key) const { return checked_text(need(key), place(key)); }

std::string Table::text(std::string_view key, const std::string& otherwise) const {
    return has(key) ? text(key) : otherwise;
}

std::string Table::choice(std::string_view key, const std::vector<std::string>& known,
                          std::string_view otherwise) const {
    if (otherwise.empty() && !has(key)) fail(key, "is missing: one of " + listing(known));
    const std::string value = text(key, std::string(otherwise));
    if (std::find(known.begin(), known.end(), value) == known.end())
        fail(key, fmt::format("\"{}\" is not allowed{}; one of {}", value, suggestion(value, known), listing(known)));
    return value;
}

std::vector<double> Table::numbers(std::string_view key, const Range& range, std::size_t count) const {
    return checked_list<double>(need(key), place(key), count, [&range](const toml::node& node, const Place& where) {
        return checked_number(node, where, range);
    });
}

std::vector<std::vector<double>> Table::points(std::string_view key, const Range& range, std::size_t count) const {
    return checked_list<std::vector<double>>(need(key), place(key), 0, [&](const toml::node& entry, const Place& at) {
        return checked_list<double>(entry, at, count, [&range](const toml::node& node, const Place& where) {
            return checked_number(node, where, range);
        });
    });
}

std::vector<std::int64_t> Table::wholes(std::string_view key, std::int64_t least, std::size_t count) const {
    return checked_list<std::int64_t>(
        need(key), place(key), count,
        [least](const toml::node& node, const Place& where) { return checked_whole(node, where, least); });
}

std::vector<std::string> Table::texts(std::string_view key) const {
    return checked_list<std::string>(need(key), place(key), 0, checked_text);
}

Table Table::table(std::string_view key) const {
    const toml::node& node = need(key);
    if (!node.is_table()) fail(key, fmt::format("{}: a table is expected", shown(node)));
    return Table(*node.as_table(), place(key));
}

std::vector<Table> Table::tables(std::string_view key) const {
    if (!has(key)) return {};
    const toml::array* list = need(key).as_array();
    if (list == nullptr) fail(key, fmt::format("{}: a list of tables is expected", shown(need(key))));
    std::vector<Table> out;
    for (std::size_t i = 0; i < list->size(); ++i) {
        const toml::node& entry = *list->get(i);
        const Place where = place_of(entry, place_.file, fmt::format("{}[{}]", joined(place_.path, key), i));
        if (!entry.is_table()) throw SceneFailure(where, fmt::format("{}: a table is expected", shown(entry)));
        out.emplace_back(*entry.as_table(), where);
    }
    return out;
}

std::vector<std::string> Table::keys() const {
    std::vector<std::string> out;
    for (const auto& [key, node] : *table_) out.emplace_back(key.str());
    return out;
}

bool Table::is_text(std::string_view key) const { return has(key) && need(key).is_string(); }
bool Table::is_list(std::string_view key) const { return has(key) && need(key).is_array(); }

}  // namespace cli
