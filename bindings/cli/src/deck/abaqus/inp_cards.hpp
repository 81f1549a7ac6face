// SPDX-License-Identifier: BSD-3-Clause
// An Abaqus input file as cards: keyword lines with their data lines, with includes expanded.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "text/error.hpp"

namespace cli {

struct InpLine {
    std::vector<std::string> fields;  // between the commas, trimmed
    bool continues = false;           // ends with a comma
    Place place;

    // The fields from `first` on; an empty one is 0.
    [[nodiscard]] std::vector<double> numbers(std::size_t first = 0) const;
};

struct InpCard {
    std::string keyword;  // upper case, single blanks: "SOLID SECTION"; in full if it is known
    // Names in upper case, in full if they are known, and so the values of those that have a few; "" where there is no
    // value.
    std::vector<std::pair<std::string, std::string>> parameters;
    std::vector<InpLine> lines;
    Place place;

    [[nodiscard]] bool has(const std::string& name) const;
    // "" if it is missing.
    [[nodiscard]] std::string parameter(const std::string& name) const;
    [[nodiscard]] std::string required(const std::string& name) const;
    [[nodiscard]] const InpLine& first_line() const;
    // The numbers of all lines, where a row takes several.
    [[nodiscard]] std::vector<double> row() const;
    // Refuses a value of a parameter.
    [[noreturn]] void refuse(const std::string& name, const std::string& value, const std::string& known) const;
    // Refuses any parameter that is not known, and any value of those whose values are known.
    void check() const;
};

// "**" begins a comment; keywords and parameters are case-insensitive; a keyword line that ends with a comma continues
// on the next. files: the bytes of all files read, one after another. Throws SceneFailure with file and line.
std::vector<InpCard> read_cards(const std::string& path, const Place& place, std::string& bytes);

std::string upper(std::string text);
// Throw SceneFailure at `place`. Numbers may be written 1.d0.
double inp_number(const std::string& field, const Place& place);
std::optional<std::int64_t> inp_whole(const std::string& field);
std::int64_t inp_whole(const std::string& field, const Place& place);

}  // namespace cli
