// SPDX-License-Identifier: BSD-3-Clause
#include "report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace bench {

void print_rows(const Row& head, const std::vector<Row>& rows) {
    std::vector<std::size_t> width;
    for (const auto& cell : head) width.push_back(cell.size());
    for (const auto& row : rows) {
        for (std::size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], row[i].size());
    }
    const auto line = [&](const Row& row) {
        for (std::size_t i = 0; i < row.size(); ++i) std::printf("%-*s  ", static_cast<int>(width[i]), row[i].c_str());
        std::printf("\n");
    };
    line(head);
    for (const auto& row : rows) line(row);
}

std::string number(double value, const char* format) {
    if (std::isnan(value)) return "-";
    char text[40];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

}  // namespace bench
