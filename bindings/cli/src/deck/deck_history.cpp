// SPDX-License-Identifier: BSD-3-Clause
#include "deck/deck_history.hpp"

#include <algorithm>
#include <iterator>

namespace cli::abaqus {

namespace {

// Returns the first point at x or behind.
Points::const_iterator first_from(const Points& points, double x) {
    return std::partition_point(points.begin(), points.end(), [&](const auto& point) { return point.first < x; });
}

}  // namespace

double between(const Points& points, double x) {
    const auto at = first_from(points, x);
    if (at == points.begin()) return points.front().second;
    if (at == points.end()) return points.back().second;
    const auto& [a, fa] = *std::prev(at);
    const auto& [b, fb] = *at;
    return fa + (fb - fa) * (x - a) / (b - a);
}

Points lines_of(const Amplitude& amplitude) {
    if (!amplitude.smooth) return amplitude.points;
    Points out{amplitude.points.front()};
    for (std::size_t i = 1; i < amplitude.points.size(); ++i)
        for (int k = 1; k <= 16; ++k) {
            const double x = k / 16.0;
            const auto& [a, fa] = amplitude.points[i - 1];
            const auto& [b, fb] = amplitude.points[i];
            out.emplace_back(a + (b - a) * x, fa + (fb - fa) * x * x * x * (10 - 15 * x + 6 * x * x));
        }
    return out;
}

}  // namespace cli::abaqus
