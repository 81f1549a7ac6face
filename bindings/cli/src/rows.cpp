// SPDX-License-Identifier: BSD-3-Clause
#include "rows.hpp"

#include <algorithm>

#include "number.hpp"

namespace cli {

namespace {

std::vector<std::string> parts(std::string_view text, char separator) {
    std::vector<std::string> out;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(separator), text.size());
        out.emplace_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return out;
}

}  // namespace

std::vector<std::map<std::string, double>> rows_of(std::string_view history) {
    std::vector<std::map<std::string, double>> out;
    const std::vector<std::string> rows = parts(history, '\n');
    if (rows.empty()) return out;
    const std::vector<std::string> titles = parts(rows.front(), ',');
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const std::vector<std::string> cells = parts(rows[i], ',');
        std::map<std::string, double> of;
        for (std::size_t k = 0; k < std::min(titles.size(), cells.size()); ++k)
            of.emplace(titles[k], number_in(cells[k]));
        out.push_back(std::move(of));
    }
    return out;
}

}  // namespace cli
