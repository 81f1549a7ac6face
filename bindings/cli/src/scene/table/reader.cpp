// SPDX-License-Identifier: BSD-3-Clause
#include "scene/table/reader.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "scene/table/scene_keys.hpp"
#include "scene/table/setting.hpp"
#include "text/wording.hpp"

namespace cli {

namespace {
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

// The place of a value in the object at `of`, or in a setting of the command line.
Place place_of(const toml::node& node, const Place& of, const std::string& path) {
    const toml::source_path_ptr& source = node.source().path;
    if (source != nullptr && *source == setting_source) return {*source, path, 0};
    return {of.file, path, of.whole ? of.line : static_cast<int>(node.source().begin.line), of.whole};
}

double checked_number(const toml::node& node, const Place& where, const Range& range) {
    if (!node.is_number())
        throw SceneFailure(where, fmt::format("{}: a number {} is expected", shown(node), range.text));
    const double value = number_of(node);
    if (!range.contains(value)) throw SceneFailure(where, fmt::format("{} is not allowed: {}", value, range.text));
    return value;
}

// Returns what is allowed, in words.
std::string whole_words(const KeyRow& row) {
    if (row.most == INT64_MAX) return fmt::format(">= {}", row.least);
    if (row.least == row.most) return fmt::format("{}", row.least);
    return row.least + 1 == row.most ? fmt::format("{} or {}", row.least, row.most)
                                     : fmt::format("from {} to {}", row.least, row.most);
}

std::int64_t checked_whole(const toml::node& node, const Place& where, const KeyRow& row) {
    if (!node.is_integer())
        throw SceneFailure(where, fmt::format("{}{}: a whole number{} is expected: {}", shown(node),
                                              node.is_floating_point() ? " has a decimal point" : "",
                                              node.is_floating_point() ? " without one" : "", whole_words(row)));
    const std::int64_t value = *node.value<std::int64_t>();
    if (value < row.least || value > row.most)
        throw SceneFailure(where, fmt::format("{} is not allowed: {}{}", value,
                                              row.most == INT64_MAX ? "a whole number " : "", whole_words(row)));
    return value;
}

// known: what is allowed; empty if anything is.
std::string checked_text(const toml::node& node, const Place& where, const std::vector<std::string>& known) {
    if (!node.is_string())
        throw SceneFailure(where, fmt::format("{}: a text in quotes is expected{}{}", shown(node),
                                              known.empty() ? "" : ": ", listing(known)));
    std::string text = *node.value<std::string>();
    if (text.size() > most_text_bytes)
        throw SceneFailure(where, fmt::format("\"{}\" has {} bytes: at most {} are allowed", shortened(text),
                                              text.size(), most_text_bytes));
    if (!known.empty() && std::find(known.begin(), known.end(), text) == known.end())
        throw SceneFailure(where, fmt::format("\"{}\" is not allowed{}; one of {}", shortened(text),
                                              suggestion(text, known), listing(known)));
    return text;
}

std::string list_words(const Count& count) {
    if (count.most == 0)
        return count.least == 1 ? "at least one is expected" : fmt::format("at least {} are expected", count.least);
    if (count.least == count.most) return fmt::format("a list of {} is expected", count.least);
    return fmt::format("a list of {} {} {} is expected", count.least, count.between ? "to" : "or", count.most);
}

template <class Value, class Check>
std::vector<Value> checked_list(const toml::node& node, const Place& where, const Count& count, Check&& check) {
    const toml::array* list = node.as_array();
    if (list == nullptr)
        throw SceneFailure(where, fmt::format("{}: {}", shown(node),
                                              count.most > 0 ? list_words(count) : std::string("a list is expected")));
    if (list->size() < count.least || (count.most > 0 && list->size() > count.most) ||
        (!count.between && list->size() != count.least && list->size() != count.most))
        throw SceneFailure(where, fmt::format("{} entries: {}", list->size(), list_words(count)));
    std::vector<Value> out;
    for (std::size_t i = 0; i < list->size(); ++i) {
        const toml::node& entry = *list->get(i);
        out.push_back(check(entry, place_of(entry, where, fmt::format("{}[{}]", where.path, i))));
    }
    return out;
}
}  // namespace

Table::Table(const toml::table& table, Place place, const KeyTable& keys, Scenes scenes, const Origins* origins)
    : table_(&table), place_(std::move(place)), keys_(&keys), scenes_(scenes), origins_(origins) {
    if (keys.row("schema") != nullptr) (void)whole("schema");  // another version has other keys
    check_keys();
    for (const KeyRule& rule : keys.rules)
        if (!rule.message.empty() && (rule.scenes == Scenes::any || rule.scenes == scenes_)) check_rule(rule);
    for (const std::string& key : this->keys()) check_value(row(key));
}

void Table::check_keys() const {
    std::vector<std::string> known;
    for (const KeyRow& row : keys_->rows)
        if (row.scenes == Scenes::any || row.scenes == scenes_) known.push_back(row.key);
    for (const std::string& key : keys()) {
        if (std::find(known.begin(), known.end(), key) != known.end()) continue;
        if (keys_->row(key) != nullptr)
            fail(key, scenes_ == Scenes::mesh ? "is not for a scene with [mesh]" : "is for a scene with [mesh]");
        const auto written_so = [&](const KeyRow& row) {
            return std::find(row.synonyms.begin(), row.synonyms.end(), key) != row.synonyms.end();
        };
        const auto meant = std::find_if(keys_->rows.begin(), keys_->rows.end(), written_so);
        const std::string hint =
            meant == keys_->rows.end() ? suggestion(key, known) : fmt::format(" (did you mean '{}'?)", meant->key);
        fail(key, fmt::format("unknown key{}; allowed here: {}", hint, listing(known)));
    }
}

bool Table::given(std::string_view key) const {
    const toml::node* node = table_->get(key);
    const KeyRow* of = keys_->row(key);
    const bool is_flag = of != nullptr && of->kind == KeyKind::flag;
    return node != nullptr && !(is_flag && node->is_boolean() && !*node->value<bool>());
}

// A value that its own row does not allow is complained of where it is read.
bool Table::is_one_of(const std::string& key, const std::vector<std::string>& values, bool otherwise) const {
    const toml::node* node = table_->get(key);
    const KeyRow& of = row(key);
    if (node != nullptr && of.kind == KeyKind::whole) {
        const auto whole = node->is_integer() ? *node->value<std::int64_t>() : of.least - 1;
        if (whole < of.least || whole > of.most) return otherwise;
    }
    if (node != nullptr && of.kind == KeyKind::choice &&
        std::find(of.choices.begin(), of.choices.end(), node->value_or(std::string())) == of.choices.end())
        return otherwise;
    const std::string value = node != nullptr ? shown(*node) : of.initial;
    return std::any_of(values.begin(), values.end(),
                       [&](const std::string& v) { return value == v || value == "\"" + v + "\""; });
}

void Table::check_rule(const KeyRule& rule) const {
    const auto is_given = [this](const std::string& key) { return given(key); };
    const auto first = std::find_if(rule.keys.begin(), rule.keys.end(), is_given);
    const auto count = std::count_if(rule.keys.begin(), rule.keys.end(), is_given);
    const auto other = std::find_if(rule.others.begin(), rule.others.end(), is_given);
    const auto counted = [&] { return fmt::format("{} ({} are given)", rule.message, count); };
    switch (rule.kind) {
        case KeyRule::exactly_one:
            if (count != 1) fail(rule.keys.front(), rule.message.starts_with("is") ? rule.message : counted());
            return;
        case KeyRule::at_most_one:
            if (count > 1) fail(*first, rule.message);
            return;
        case KeyRule::at_least_one:
            if (count == 0) fail(rule.keys.front(), rule.message);
            return;
        case KeyRule::needs:
            if (count > 0 && other == rule.others.end())
                fail(rule.message.starts_with("is missing") ? rule.others.front() : *first, rule.message);
            return;
        case KeyRule::excludes:
            if (count > 0 && other != rule.others.end()) fail(*first, rule.message);
            return;
        case KeyRule::only_where:
            if (count > 0 && !is_one_of(rule.others.front(), rule.values, true)) fail(*first, rule.message);
            return;
        case KeyRule::needed_where:
            if (count == 0 && is_one_of(rule.others.front(), rule.values, false)) fail(rule.keys.front(), rule.message);
            return;
    }
}

const KeyRow& Table::row(std::string_view key) const {
    const KeyRow* found = keys_->row(key);
    if (found == nullptr) throw std::logic_error(fmt::format("table {} has no key {}", keys_->name, key));
    return *found;
}

Place Table::placed(const toml::node& node, const std::string& path) const {
    Place place = place_of(node, place_, path);
    if (origins_ == nullptr || place.file != place_.file) return place;
    const auto origin = origins_->find(place.line);
    if (origin == origins_->end()) return place;
    return {origin->second.file, origin->second.path + ": " + path, origin->second.line, true};
}

Place Table::place(std::string_view key) const {
    const toml::node* node = table_->get(key);
    const std::string path = joined(place_.path, key);
    return node != nullptr ? placed(*node, path) : Place{place_.file, path, place_.line, place_.whole};
}

void Table::fail(std::string_view key, const std::string& text) const { throw SceneFailure(place(key), text); }

namespace {

// Returns the type that a missing key with this row would need to have.
std::string expected_words(const KeyRow& row) {
    switch (row.kind) {
        case KeyKind::number:
            return fmt::format("is missing: a number {} is expected", row.range->text);
        case KeyKind::whole:
            return fmt::format("is missing: a whole number {} is expected", whole_words(row));
        case KeyKind::text:
        case KeyKind::choice:
            return row.choices.empty() ? "is missing" : "is missing: one of " + listing(row.choices);
        default:
            return "is missing";
    }
}

// The default of a row; null if it has none, or one in words. Rows live as long as the program.
const toml::node* default_of(const KeyRow& row) {
    static std::map<const KeyRow*, toml::table> known;
    const auto [found, added] = known.try_emplace(&row);
    if (added && !row.initial.empty()) {
        try {
            found->second = toml::parse("value = " + row.initial);
        } catch (const toml::parse_error&) {  // words
        }
    }
    return found->second.get("value");
}

}  // namespace

const toml::node& Table::need(std::string_view key) const {
    const KeyRow& of = row(key);
    const toml::node* node = table_->get(key);
    if (node == nullptr) node = default_of(of);
    if (node == nullptr) fail(key, expected_words(of));
    return *node;
}

double Table::number(std::string_view key) const { return checked_number(need(key), place(key), *row(key).range); }

double Table::number(std::string_view key, double otherwise) const { return has(key) ? number(key) : otherwise; }

std::int64_t Table::whole(std::string_view key) const { return checked_whole(need(key), place(key), row(key)); }

std::int64_t Table::whole(std::string_view key, std::int64_t otherwise) const {
    return has(key) ? whole(key) : otherwise;
}

bool Table::flag(std::string_view key) const {
    if (!need(key).is_boolean()) fail(key, fmt::format("{}: true or false is expected", shown(need(key))));
    return *need(key).value<bool>();
}

std::string Table::text(std::string_view key) const { return checked_text(need(key), place(key), row(key).choices); }

std::string Table::text(std::string_view key, const std::string& otherwise) const {
    return has(key) ? text(key) : otherwise;
}

std::string Table::choice(std::string_view key, const std::vector<std::string>& known,
                          std::string_view otherwise) const {
    return has(key) ? checked_text(need(key), place(key), known) : std::string(otherwise);
}

std::vector<double> Table::numbers(std::string_view key, std::size_t count) const {
    const KeyRow& of = row(key);
    return checked_list<double>(
        need(key), place(key), count > 0 ? Count{count, count} : of.count,
        [&of](const toml::node& node, const Place& where) { return checked_number(node, where, *of.range); });
}

std::vector<std::vector<double>> Table::points(std::string_view key, std::size_t count) const {
    const KeyRow& of = row(key);
    return checked_list<std::vector<double>>(
        need(key), place(key), of.count, [&](const toml::node& entry, const Place& at) {
            return checked_list<double>(
                entry, at, Count{count, count},
                [&of](const toml::node& node, const Place& where) { return checked_number(node, where, *of.range); });
        });
}

std::vector<std::int64_t> Table::wholes(std::string_view key, std::size_t count) const {
    const KeyRow& of = row(key);
    return checked_list<std::int64_t>(
        need(key), place(key), Count{count, count},
        [&of](const toml::node& node, const Place& where) { return checked_whole(node, where, of); });
}

std::vector<std::string> Table::texts(std::string_view key) const {
    const KeyRow& of = row(key);
    return checked_list<std::string>(
        need(key), place(key), of.count,
        [&of](const toml::node& node, const Place& where) { return checked_text(node, where, of.choices); });
}

Table Table::table(std::string_view key) const {
    const toml::node& node = need(key);
    if (!node.is_table()) fail(key, fmt::format("{}: a table is expected", shown(node)));
    return Table(*node.as_table(), place(key), scene_table(row(key).content), scenes_);
}

Table Table::table_or_empty(std::string_view key) const {
    static const toml::table none;
    return has(key) ? table(key) : Table(none, place(key), scene_table(row(key).content), scenes_);
}

// Checks the value, also if nothing reads it later.
void Table::check_value(const KeyRow& of) const {
    const bool alone = of.or_one && !is_list(of.key);
    switch (of.kind) {
        case KeyKind::number:
            (void)number(of.key);
            return;
        case KeyKind::whole:
            (void)whole(of.key);
            return;
        case KeyKind::flag:
            (void)flag(of.key);
            return;
        case KeyKind::text:
        case KeyKind::choice:
            (void)text(of.key);
            return;
        case KeyKind::texts:
            (void)texts(of.key);
            return;
        case KeyKind::numbers:
            (void)(alone ? std::vector<double>{number(of.key)} : numbers(of.key));
            return;
        case KeyKind::wholes:
            if (alone) (void)whole(of.key);
            return;
        case KeyKind::points:
        case KeyKind::table:
        case KeyKind::tables:
            return;
    }
}

std::vector<Table> Table::tables(std::string_view key) const {
    if (!has(key)) return {};
    const toml::array* list = need(key).as_array();
    if (list == nullptr) fail(key, fmt::format("{}: a list of tables is expected", shown(need(key))));
    if (list->size() < row(key).count.least) fail(key, "is empty: at least one is expected");
    std::vector<Table> out;
    for (std::size_t i = 0; i < list->size(); ++i) {
        const toml::node& entry = *list->get(i);
        const Place where = placed(entry, fmt::format("{}[{}]", joined(place_.path, key), i));
        if (!entry.is_table()) throw SceneFailure(where, fmt::format("{}: a table is expected", shown(entry)));
        out.emplace_back(*entry.as_table(), where, scene_table(row(key).content), scenes_);
    }
    return out;
}

std::vector<std::string> Table::keys() const {
    std::vector<std::string> out;
    for (const auto& [key, node] : *table_) out.emplace_back(key.str());
    return out;
}

bool Table::is_list(std::string_view key) const { return has(key) && need(key).is_array(); }

}  // namespace cli
