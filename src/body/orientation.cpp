// SPDX-License-Identifier: BSD-3-Clause
#include "body/orientation.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/cancel_scope.hpp"
#include "base/numbers.hpp"
#include "mesh/points.hpp"

namespace delam {

namespace {

// Axes at an angle with a smaller sine count as parallel.
constexpr double parallel = 1e-8;

bool normalise(Point& v) {
    const double largest = max_abs(v);
    if (!(largest > 0.0)) return false;
    for (double& c : v) c /= largest;
    const double length = std::sqrt(dot(v, v));
    for (double& c : v) c /= length;
    return true;
}

}  // namespace

bool orthonormal_axes(std::span<const double, 3> first, std::span<const double, 3> second, Axes& axes) {
    Point one{first[0], first[1], first[2]}, two{second[0], second[1], second[2]};
    if (!normalise(one) || !normalise(two)) return false;
    for (int pass = 0; pass < 2; ++pass) {
        const double along = dot(one, two);
        for (std::size_t i = 0; i < 3; ++i) two[i] -= along * one[i];
        if (!(dot(two, two) > parallel * parallel)) return false;
        normalise(two);
    }
    const Point three = cross(one, two);
    for (std::size_t i = 0; i < 3; ++i) {
        axes[i] = one[i];
        axes[3 + i] = two[i];
        axes[6 + i] = three[i];
    }
    return true;
}

Orientation oriented(const Orientation& before, std::int64_t mesh_cells, std::span<const std::int64_t> cells,
                     std::span<const Axes> chosen) {
    // The new orientation of each cell, in axes of both lists; then renumbered in the order of the cells.
    const auto old = static_cast<std::int32_t>(before.axes.size());
    std::vector<std::int32_t> of_cell = before.of_cell;
    of_cell.resize(index(mesh_cells), -1);
    for (std::size_t i = 0; i < cells.size(); ++i) of_cell[index(cells[i])] = old + static_cast<std::int32_t>(i);
    Orientation after;
    std::map<Axes, std::int32_t> number;
    for (std::int32_t& cell : of_cell) {
        poll_cancel("orientation");
        if (cell < 0) continue;
        const auto k = index(cell);
        const Axes& own = cell < old ? before.axes[k] : chosen[k - before.axes.size()];
        const auto [found, inserted] = number.try_emplace(own, static_cast<std::int32_t>(after.axes.size()));
        if (inserted) after.axes.push_back(own);
        cell = found->second;
    }
    after.of_cell = std::move(of_cell);
    return after;
}

}  // namespace delam
