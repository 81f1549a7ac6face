// SPDX-License-Identifier: BSD-3-Clause
// Strict reading of one TOML table: every key has a type and a range and is known, or the error states where it is and
// what is allowed.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "error.hpp"
#include "toml.hpp"

namespace cli {

// Of a title or a name, which files of HDF5 keep in up to 64 kB.
constexpr std::size_t most_text_bytes = 4096;
// The beginning of a text that would be too long for a message.
std::string shortened(const std::string& text);

// An open or closed interval, with its description in words.
struct Range {
    double lower;
    double upper;
    bool lower_open;
    bool upper_open;
    std::string_view text;

    [[nodiscard]] bool contains(double value) const;
};

extern const Range any_number;
extern const Range positive;
extern const Range not_negative;
extern const Range fraction;           // [0, 1]
extern const Range poisson_range;      // (-1, 0.5)
extern const Range pairing_tolerance;  // [0, 0.5)

class Table {
public:
    Table(const toml::table& table, Place place) : table_(&table), place_(std::move(place)) {}

    // Refuses any key that is not listed, with the nearest names.
    void only(std::initializer_list<std::string_view> keys) const;
    void only(const std::vector<std::string>& keys) const;

    [[nodiscard]] bool has(std::string_view key) const { return table_->contains(key); }
    [[nodiscard]] const Place& place() const { return place_; }
    [[nodiscard]] Place place(std::string_view key) const;
    [[noreturn]] void fail(std::string_view key, const std::string& text) const;

    [[nodiscard]] double number(std::string_view key, const Range& range) const;
    [[nodiscard]] double number(std::string_view key, const Range& range, double otherwise) const;
    [[nodiscard]] std::int64_t whole(std::string_view key, std::int64_t least) const;
    [[nodiscard]] std::int64_t whole(std::string_view key, std::int64_t least, std::int64_t otherwise) const;
    // Of any size; range: words for the error that it is no integer.
    [[nodiscard]] std::int64_t whole(std::string_view key, const std::string& range) const;
    [[nodiscard]] bool flag(std::string_view key, bool otherwise) const;
    // words: what is allowed; only the type is checked.
    [[nodiscard]] std::string word(std::string_view key, const std::string& words) const;
    [[nodiscard]] std::string text(std::string_view key) const;
    [[nodiscard]] std::string text(std::string_view key, const std::string& otherwise) const;
    [[nodiscard]] std::string choice(std::string_view key, const std::vector<std::string>& known,
                                     std::string_view otherwise) const;
    // count 0: any number of entries, but at least one.
    [[nodiscard]] std::vector<double> numbers(std::string_view key, const Range& range, std::size_t count = 0) const;
    // A list of lists of count entries each.
    [[nodiscard]] std::vector<std::vector<double>> points(std::string_view key, const Range& range,
                                                          std::size_t count) const;
    [[nodiscard]] std::vector<std::int64_t> wholes(std::string_view key, std::int64_t least, std::size_t count) const;
    [[nodiscard]] std::vector<std::string> texts(std::string_view key) const;
    [[nodiscard]] Table table(std::string_view key) const;
    // Empty if the key is missing.
    [[nodiscard]] std::vector<Table> tables(std::string_view key) const;
    // Keys in the order of the table.
    [[nodiscard]] std::vector<std::string> keys() const;
    [[nodiscard]] bool is_text(std::string_view key) const;
    [[nodiscard]] bool is_list(std::string_view key) const;

private:
    [[nodiscard]] const toml::node& need(std::string_view key) const;

    const toml::table* table_;
    Place place_;
};

// " (did you mean 'young'?)" or "".
std::string suggestion(std::string_view word, const std::vector<std::string>& known);
// "a, b, c"
std::string listing(const std::vector<std::string>& names);

}  // namespace cli
