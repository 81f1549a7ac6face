// SPDX-License-Identifier: BSD-3-Clause
// Reads one TOML table strictly by its rows (keys.hpp): every key must be known and have the type and range of its row,
// and the rules of the table must hold. An error says where the fault is and what is allowed.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/table/keys.hpp"
#include "scene/table/toml.hpp"
#include "text/error.hpp"

namespace cli {

// Maps the line at which a table of a scene begins to the place that the table comes from.
using Origins = std::map<int, Place>;

class Table {
public:
    // Checks the keys and the rules; types and ranges are checked where a value is read. origins: of tables in this
    // one, which have their places; null: they stand where they are written.
    Table(const toml::table& table, Place place, const KeyTable& keys, Scenes scenes, const Origins* origins = nullptr);

    [[nodiscard]] bool has(std::string_view key) const { return table_->contains(key); }
    [[nodiscard]] const Place& place() const { return place_; }
    [[nodiscard]] Place place(std::string_view key) const;
    [[noreturn]] void fail(std::string_view key, const std::string& text) const;

    // The default of the row counts if `otherwise` is not given; if the row has none, the key is needed.
    [[nodiscard]] double number(std::string_view key) const;
    [[nodiscard]] double number(std::string_view key, double otherwise) const;
    [[nodiscard]] std::int64_t whole(std::string_view key) const;
    [[nodiscard]] std::int64_t whole(std::string_view key, std::int64_t otherwise) const;
    [[nodiscard]] bool flag(std::string_view key) const;
    [[nodiscard]] std::string text(std::string_view key) const;
    [[nodiscard]] std::string text(std::string_view key, const std::string& otherwise) const;
    // Reads a word where fewer words are allowed than the row says.
    [[nodiscard]] std::string choice(std::string_view key, const std::vector<std::string>& known,
                                     std::string_view otherwise) const;
    // count 0: as many as the row allows.
    [[nodiscard]] std::vector<double> numbers(std::string_view key, std::size_t count = 0) const;
    // A list of lists of count entries each.
    [[nodiscard]] std::vector<std::vector<double>> points(std::string_view key, std::size_t count) const;
    [[nodiscard]] std::vector<std::int64_t> wholes(std::string_view key, std::size_t count) const;
    [[nodiscard]] std::vector<std::string> texts(std::string_view key) const;
    [[nodiscard]] Table table(std::string_view key) const;
    // Returns a table without entries if the key is missing.
    [[nodiscard]] Table table_or_empty(std::string_view key) const;
    // Empty if the key is missing.
    [[nodiscard]] std::vector<Table> tables(std::string_view key) const;
    // Keys in the order of the table.
    [[nodiscard]] std::vector<std::string> keys() const;
    [[nodiscard]] bool is_list(std::string_view key) const;

private:
    void check_keys() const;
    void check_rule(const KeyRule& rule) const;
    void check_value(const KeyRow& of) const;
    [[nodiscard]] bool given(std::string_view key) const;  // and not false
    [[nodiscard]] bool is_one_of(const std::string& key, const std::vector<std::string>& values, bool otherwise) const;
    [[nodiscard]] const KeyRow& row(std::string_view key) const;
    [[nodiscard]] const toml::node& need(std::string_view key) const;
    [[nodiscard]] Place placed(const toml::node& node, const std::string& path) const;

    const toml::table* table_;
    Place place_;
    const KeyTable* keys_;
    Scenes scenes_;
    const Origins* origins_;
};

}  // namespace cli
