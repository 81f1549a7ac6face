// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

// True if a name matches a pattern in which * stands for any characters or none.
inline bool fits(std::string_view pattern, std::string_view name) {
    std::size_t star = pattern.find('*');
    if (star == std::string_view::npos) return pattern == name;
    if (!name.starts_with(pattern.substr(0, star))) return false;
    name.remove_prefix(star);
    // Each part between two stars at its first place, which leaves most of the name for the parts behind it.
    for (;;) {
        pattern.remove_prefix(star + 1);
        star = pattern.find('*');
        if (star == std::string_view::npos) return name.ends_with(pattern);
        const std::size_t at = name.find(pattern.substr(0, star));
        if (at == std::string_view::npos) return false;
        name.remove_prefix(at + star);
    }
}

// Returns how many of the names, which are sorted, begin with a text.
inline std::size_t number_beginning_with(const std::vector<std::string>& sorted, const std::string& text) {
    const auto first = std::lower_bound(sorted.begin(), sorted.end(), text);
    const auto last =
        std::partition_point(first, sorted.end(), [&](const std::string& name) { return name.starts_with(text); });
    return static_cast<std::size_t>(last - first);
}

inline bool is_pattern(std::string_view text) { return text.find('*') != std::string_view::npos; }

}  // namespace cli
