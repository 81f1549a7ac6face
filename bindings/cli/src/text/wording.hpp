// SPDX-License-Identifier: BSD-3-Clause
// Names and texts as messages quote them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

// The longest title or name, in bytes; files of HDF5 keep texts of up to 64 kB.
constexpr std::size_t most_text_bytes = 4096;
// The deepest nesting of tables, lists and objects in a file; the deepest scene of the examples has 7.
constexpr int most_levels = 32;
// Returns the beginning of a text that would be too long for a message.
std::string shortened(const std::string& text);
// Returns " (did you mean 'young'?)", or "" if no known word is near.
std::string suggestion(std::string_view word, const std::vector<std::string>& known);
// Breaks a line at blanks so that no part is longer than `width` unless a word is; further parts begin with four
// blanks.
std::string wrapped(const std::string& line, std::size_t width);
// Returns "a, b, c".
std::string listing(const std::vector<std::string>& names);

}  // namespace cli
