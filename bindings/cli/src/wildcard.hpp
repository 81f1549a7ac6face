// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace cli {

// Whether a name matches a pattern in which * stands for any characters or none.
inline bool fits(std::string_view pattern, std::string_view name) {
    const std::size_t star = pattern.find('*');
    if (star == std::string_view::npos) return pattern == name;
    if (name.substr(0, star) != pattern.substr(0, star)) return false;
    for (std::size_t i = star; i <= name.size(); ++i)
        if (fits(pattern.substr(star + 1), name.substr(i))) return true;
    return false;
}

inline bool is_pattern(std::string_view text) { return text.find('*') != std::string_view::npos; }

}  // namespace cli
