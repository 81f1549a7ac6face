// SPDX-License-Identifier: BSD-3-Clause
#include "result/history/rows.hpp"

#include <algorithm>
#include <cmath>

#include "text/number.hpp"

namespace cli {

namespace {

std::vector<std::string> pieces_of(std::string_view text, char separator) {
    std::vector<std::string> out;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(separator), text.size());
        out.emplace_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return out;
}

}  // namespace

Rows rows_of(std::string_view history) {
    Rows out;
    const std::vector<std::string> rows = pieces_of(history, '\n');
    if (rows.empty()) return out;
    const std::vector<std::string> titles = pieces_of(rows.front(), ',');
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const std::vector<std::string> cells = pieces_of(rows[i], ',');
        Row of;
        for (std::size_t k = 0; k < std::min(titles.size(), cells.size()); ++k)
            of.emplace(titles[k], number_in(cells[k]));
        out.push_back(std::move(of));
    }
    return out;
}

double number_of(const Row& row, std::string_view column) {
    const auto found = row.find(column);
    return found == row.end() ? 0.0 : found->second;
}

double energy_scale(const Row& row) {
    const double stored =
        number_of(row, "stored_bulk") + number_of(row, "stored_interface") + number_of(row, "load_potential");
    return std::max(std::abs(stored), std::abs(number_of(row, "work")));
}

}  // namespace cli
