// SPDX-License-Identifier: BSD-3-Clause
#include "text/wording.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include <fmt/format.h>

namespace cli {

namespace {
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
}  // namespace

std::string shortened(const std::string& text) {
    constexpr std::size_t most = 60;
    if (text.size() <= most) return text;
    std::size_t end = most;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;  // within a character of UTF-8
    return text.substr(0, end) + "..";
}

std::string wrapped(const std::string& line, std::size_t width) {
    const std::string indent = "    ";
    std::string out, rest = line;
    while (rest.size() > width) {
        std::size_t at = rest.rfind(' ', width);
        if (at == std::string::npos || at < indent.size()) at = rest.find(' ', width);
        if (at == std::string::npos) break;
        out += rest.substr(0, at) + "\n";
        rest = indent + rest.substr(at + 1);
    }
    return out + rest;
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

}  // namespace cli
