// SPDX-License-Identifier: BSD-3-Clause
#include "body/orientation.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/cancel_scope.hpp"

namespace delam {

namespace {

// Axes at an angle with a smaller sine count as parallel.
constexpr double parallel = 1e-8;

bool normalise(double* v) {
    const double largest = std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
    if (!(largest > 0.0)) return false;
    for (int i = 0; i < 3; ++i) v[i] /= largest;
    const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int i = 0; i < 3; ++i) v[i] /= length;
    return true;
}

}  // namespace

bool orthonormal_axes(std::span<const double, 3> first, std::span<const double, 3> second, Axes& axes) {
    double* one = axes.data();
    double* two = one + 3;
    double* three = one + 6;
    std::copy(first.begin(), first.end(), one);
    std::copy(second.begin(), second.end(), two);
    if (!normalise(one) || !normalise(two)) return false;
    for (int pass = 0; pass < 2; ++pass) {
        const double along = one[0] * two[0] + one[1] * two[1] + one[2] * two[2];
        for (int i = 0; i < 3; ++i) two[i] -= along * one[i];
        if (!(two[0] * two[0] + two[1] * two[1] + two[2] * two[2] > parallel * parallel)) return false;
        normalise(two);
    }
    for (int i = 0; i < 3; ++i) three[i] = one[(i + 1) % 3] * two[(i + 2) % 3] - one[(i + 2) % 3] * two[(i + 1) % 3];
    return true;
}

Orientation oriented(const Orientation& before, std::int64_t mesh_cells, std::span<const std::int64_t> cells,
                     std::span<const Axes> chosen) {
    // The new orientation of each cell, in axes of both lists; then renumbered in the order of the cells.
    const auto old = static_cast<std::int32_t>(before.axes.size());
    std::vector<std::int32_t> of_cell = before.of_cell;
    of_cell.resize(static_cast<std::size_t>(mesh_cells), -1);
    for (std::size_t i = 0; i < cells.size(); ++i)
        of_cell[static_cast<std::size_t>(cells[i])] = old + static_cast<std::int32_t>(i);
    Orientation after;
    std::map<Axes, std::int32_t> number;
    for (std::int32_t& cell : of_cell) {
        poll_cancel("orientation");
        if (cell < 0) continue;
        const auto k = static_cast<std::size_t>(cell);
        const Axes& own = cell < old ? before.axes[k] : chosen[k - before.axes.size()];
        const auto [found, inserted] = number.try_emplace(own, static_cast<std::int32_t>(after.axes.size()));
        if (inserted) after.axes.push_back(own);
        cell = found->second;
    }
    after.of_cell = std::move(of_cell);
    return after;
}

}  // namespace delam
