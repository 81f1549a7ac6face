// SPDX-License-Identifier: BSD-3-Clause
#include "table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "delam/delam.h"

namespace harness {
namespace {

std::string quote(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += c == '\n' ? ' ' : c;
    }
    return out + '"';
}

}  // namespace

Cell::Cell(double v) : quoted(!std::isfinite(v)) {
    char line[40];
    std::snprintf(line, sizeof line, "%.4g", v);
    text = line;
    std::snprintf(line, sizeof line, "%.12g", v);
    exact = line;
}

void Table::print_text() const {
    std::printf("%s (libdelam %s, %s)\n%s\n\n", name.c_str(), delam_version(), delam_commit(), note.c_str());
    std::vector<std::size_t> width;
    for (const auto& c : columns) width.push_back(c.size());
    for (const auto& row : rows) {
        for (std::size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], row[i].text.size());
    }
    for (std::size_t i = 0; i < columns.size(); ++i)
        std::printf("%-*s  ", static_cast<int>(width[i]), columns[i].c_str());
    std::printf("\n");
    for (const auto& row : rows) {
        for (std::size_t i = 0; i < row.size(); ++i)
            std::printf("%-*s  ", static_cast<int>(width[i]), row[i].text.c_str());
        std::printf("\n");
    }
}

void Table::print_json() const {
    std::printf("{\"table\": %s, \"version\": %s, \"commit\": %s, \"note\": %s,\n \"columns\": [", quote(name).c_str(),
                quote(delam_version()).c_str(), quote(delam_commit()).c_str(), quote(note).c_str());
    for (std::size_t i = 0; i < columns.size(); ++i) std::printf("%s%s", i > 0 ? ", " : "", quote(columns[i]).c_str());
    std::printf("],\n \"rows\": [");
    for (std::size_t r = 0; r < rows.size(); ++r) {
        std::printf("%s\n  [", r > 0 ? "," : "");
        for (std::size_t i = 0; i < rows[r].size(); ++i) {
            const Cell& cell = rows[r][i];
            std::printf("%s%s", i > 0 ? ", " : "",
                        cell.quoted ? quote(cell.text).c_str() : (cell.exact.empty() ? cell.text : cell.exact).c_str());
        }
        std::printf("]");
    }
    std::printf("]}\n");
}

void progress(const std::string& text) { std::fprintf(stderr, "%s\n", text.c_str()); }

}  // namespace harness
