// SPDX-License-Identifier: BSD-3-Clause
#include "scene_matrix.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace bench {

namespace {

struct Seen {};  // the matrix; the reference need not solve

UpperMatrix upper_of(std::size_t n, const reference::Triplets& lower) {
    // Upper triangle by columns: entry (i, j), i >= j, of the lower triangle is row j of column i.
    std::vector<std::vector<std::pair<std::int32_t, double>>> columns(n);
    for (std::size_t e = 0; e < lower.value.size(); ++e)
        columns[static_cast<std::size_t>(lower.row[e])].emplace_back(static_cast<std::int32_t>(lower.column[e]),
                                                                     lower.value[e]);
    UpperMatrix out;
    for (auto& column : columns) {
        std::sort(column.begin(), column.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        const std::size_t first = out.row.size();
        for (const auto& [row, value] : column) {
            if (out.row.size() > first && out.row.back() == row) {
                out.value.back() += value;
                continue;
            }
            out.row.push_back(row);
            out.value.push_back(value);
        }
        out.start.push_back(static_cast<std::int32_t>(out.row.size()));
    }
    return out;
}

}  // namespace

UpperMatrix undamaged_matrix(const reference::SceneFile& file) {
    UpperMatrix matrix;
    const std::vector<double> adhesion = reference::Solver(file.scene, file.times.front()).field("adhesion");
    reference::DirectReference direct(file.scene);
    direct.on_matrix = [&](std::size_t n, const reference::Triplets& lower) {
        matrix = upper_of(n, lower);
        throw Seen{};
    };
    try {
        direct.solve(file.times.front(), adhesion);
    } catch (const Seen&) {
    }
    return matrix;
}

}  // namespace bench
