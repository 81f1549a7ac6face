// SPDX-License-Identifier: BSD-3-Clause
// The number at the start of a text, in C format whatever the locale is; 0 if there is none.
#pragma once

#include <algorithm>
#include <charconv>
#include <string_view>

namespace cli {

inline double number_in(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t+"), text.size()));
    double value = 0.0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

}  // namespace cli
