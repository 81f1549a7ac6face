// SPDX-License-Identifier: BSD-3-Clause
// The crack fronts of an interface as returned by the public API.
#pragma once

#include <array>
#include <vector>

#include "api.hpp"

namespace cases {

struct FrontPoint {
    std::vector<double> place, direction;
    double length, zone, zone_pairs;
    std::array<double, 3> rate;
    double total() const { return rate[0] + rate[1] + rate[2]; }
    double mixity() const { return (rate[1] + rate[2]) / total(); }
};
struct CrackFront {
    bool closed;
    std::vector<FrontPoint> points;
};

inline std::vector<CrackFront> crack_fronts(const reference::Solver& solver, std::int64_t interface = 0) {
    const reference::Scene& scene = solver.scene();
    const auto dim = static_cast<std::size_t>(scene.dimension());
    std::int64_t fronts = 0, points = 0;
    REQUIRE(scene, delam_solver_front_count, solver.get(), interface, &fronts, &points);
    const auto n = static_cast<std::size_t>(points);
    std::vector<std::int64_t> starts(static_cast<std::size_t>(fronts) + 1);
    std::vector<std::int32_t> closed(static_cast<std::size_t>(fronts));
    std::vector<double> places(n * dim), directions(n * dim), lengths(n), rates(3 * n), zones(n), pairs(n);
    REQUIRE(scene, delam_solver_front, solver.get(), interface, fronts, points, starts.data(), closed.data(),
            places.data(), directions.data(), lengths.data(), rates.data(), zones.data(), pairs.data());
    std::vector<CrackFront> found;
    for (std::size_t f = 0; f < closed.size(); ++f) {
        found.push_back({closed[f] != 0, {}});
        for (auto p = static_cast<std::size_t>(starts[f]); p < static_cast<std::size_t>(starts[f + 1]); ++p) {
            FrontPoint point{{},       {},       lengths[p],
                             zones[p], pairs[p], {rates[3 * p], rates[3 * p + 1], rates[3 * p + 2]}};
            for (std::size_t i = 0; i < dim; ++i) {
                point.place.push_back(places[p * dim + i]);
                point.direction.push_back(directions[p * dim + i]);
            }
            found.back().points.push_back(std::move(point));
        }
    }
    return found;
}

}  // namespace cases
