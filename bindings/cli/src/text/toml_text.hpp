// SPDX-License-Identifier: BSD-3-Clause
// Values as TOML text.
#pragma once

#include <string>
#include <vector>

namespace cli {

// Returns the text in quotes, with what TOML needs escaped.
std::string toml_text(const std::string& text);
// The same; a text that is not UTF-8 is taken for Latin-1.
std::string as_utf8(const std::string& text);
// The fewest digits that give the same number again.
std::string toml_number(double value);
// "[1.0, 2.0]"
std::string toml_list(const std::vector<double>& values);
std::string toml_list(const std::vector<std::string>& texts);

}  // namespace cli
