// SPDX-License-Identifier: BSD-3-Clause
// Fronts in space that grow, on two meshes each: straight ones of a double cantilever beam, and circular ones of a
// plate that is lifted from its base.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "front_points.hpp"
#include "support.hpp"

namespace growing_fronts {

using cases::crack_fronts;
using cases::expect;
using cases::expect_below;
using cases::expect_near;
using cases::FrontPoint;

constexpr double young = 70e9;

struct Kind {
    const char* name;
    std::int32_t cell;
    std::int64_t coarse, fine;  // cells along the growth
};

// Holds what a growing front shows: rates of single points, energy per area, both over the toughness.
struct Seen {
    double least = 1e300, most = 0.0, mean_least = 1e300, mean_most = 0.0, per_area = 0.0, pairs = 1e300;
    double error() const { return std::max(most - 1.0, 1.0 - least); }
};

inline std::vector<double> along(int axis) {
    std::vector<double> direction(3, 0.0);
    direction[static_cast<std::size_t>(axis)] = 1.0;
    return direction;
}

inline void open(reference::Scene& scene, double radius, bool circular) {
    const reference::Pairs pairs = scene.pairs(0);
    std::vector<std::int64_t> notch;
    for (std::size_t p = 0; p < pairs.count(); ++p) {
        const double x = scene.coordinate(pairs.node_a[p], 0), y = scene.coordinate(pairs.node_a[p], 1);
        if ((circular ? std::hypot(x, y) : x) < radius - 1e-9) notch.push_back(static_cast<std::int64_t>(p));
    }
    scene.adhesion(0, notch, std::vector<double>(notch.size(), 0.0));
}

inline reference::Scene begin(const Kind& kind, const std::vector<double>& lengths,
                              const std::vector<std::int64_t>& cells, const std::vector<double>& thickness,
                              const std::vector<std::int64_t>& through, double poisson, const reference::LawData& law) {
    reference::Scene scene(3, lengths, cells, thickness, through, kind.cell);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, young, poisson);
    if (kind.cell == DELAM_HEX8)
        scene.require(delam_problem_set_formulation(scene.problem(), -1, "incompatible"), "formulation");
    scene.law(0, law);
    return scene;
}

// A straight front of a double cantilever beam whose sides cannot move sideways.
constexpr double gc = 300.0;
inline reference::Scene straight(const Kind& kind, std::int64_t cells) {
    const double length = 40e-3, width = 6e-3, arm = 2e-3;
    reference::Scene scene = begin(kind, {length, width}, {cells, kind.cell == DELAM_HEX8 ? 4 : 2}, {arm, arm}, {2, 2},
                                   0.0, {1e14, 1e14, 1.125, 1.125, gc, gc, 1.0});
    open(scene, 12e-3, false);
    for (int axis = 0; axis < 3; ++axis) scene.hold(scene.find(-1, {length, -1, -1}, {length, 1, 1}), along(axis));
    scene.hold(scene.find(-1, {-1, -1, -1}, {length - 1e-6, 1, 1}), along(1));
    const auto pull = scene.pattern("pull", {0.0, 1.0}, {0.0, 1.2e-3});
    for (const std::int32_t body : {0, 1}) {
        const double z = body == 0 ? 0.0 : 2.0 * arm;
        const auto nodes = scene.find(body, {0, 0, z}, {0, width, z});
        scene.drive(nodes, along(2), pull, std::vector<double>(nodes.size(), body == 0 ? -1.0 : 1.0));
    }
    return scene;
}

// A quarter of a circular blister: a plate on a rigid base, lifted in the middle.
constexpr double blister_gc = 200.0;
inline reference::Scene circular(const Kind& kind, std::int64_t cells) {
    const double size = 16e-3, base = 0.5e-3, plate = 1e-3;
    reference::Scene scene = begin(kind, {size, size}, {cells, cells}, {base, plate}, {1, 1}, 0.3,
                                   {1e14, 1e14, 1.125, 1.125, blister_gc, blister_gc, 1.0});
    open(scene, 6e-3, true);
    for (int axis = 0; axis < 3; ++axis) scene.hold(scene.find(0, {-1, -1, -1}, {1, 1, 1}), along(axis));
    scene.hold(scene.find(1, {0, -1, -1}, {0, 1, 1}), along(0));
    scene.hold(scene.find(1, {-1, 0, -1}, {1, 0, 1}), along(1));
    std::vector<std::int64_t> middle = scene.find(1, {0, 0, base + plate}, {2e-3, 2e-3, base + plate});
    std::erase_if(middle, [&](std::int64_t node) {
        return std::hypot(scene.coordinate(node, 0), scene.coordinate(node, 1)) > 2e-3 + 1e-9;
    });
    const auto lift = scene.pattern("lift", {0.0, 1.0}, {0.0, 1.9e-4});
    scene.drive(middle, along(2), lift, std::vector<double>(middle.size(), 1.0));
    return scene;
}

inline Seen analyse(reference::Scene scene, double toughness, double from) {
    scene.number("damage_tolerance", 1e-6);
    reference::Solver solver(scene, 0.0);
    constexpr int steps = 16;
    Seen seen;
    double dissipated = 0.0, area = 0.0;
    for (int k = 1; k <= steps; ++k) {
        solver.step(static_cast<double>(k) / steps);
        solver.commit();
        if (k < from * steps) continue;
        if (area > 0.0)
            seen.per_area = (solver.value("dissipated") - dissipated) / (solver.value("crack_area") - area) / toughness;
        if (!(area > 0.0)) dissipated = solver.value("dissipated"), area = solver.value("crack_area");
        const auto fronts = crack_fronts(solver);
        expect(fronts.size() == 1, "one front");
        for (const FrontPoint& point : fronts[0].points) {
            seen.least = std::min(seen.least, point.total() / toughness);
            seen.most = std::max(seen.most, point.total() / toughness);
        }
        const double mean = solver.value("energy_release_rate_mean") / toughness;
        seen.mean_least = std::min(seen.mean_least, mean);
        seen.mean_most = std::max(seen.mean_most, mean);
        seen.pairs = std::min(seen.pairs, solver.value("process_zone_pairs_mean"));
    }
    return seen;
}

inline void judge(const char* shape, const Kind& kind, const Seen& coarse, const Seen& fine) {
    for (const Seen* seen : {&coarse, &fine})
        std::printf("%s front, %s, %lld cells: G/Gc %.3f to %.3f, mean %.3f to %.3f, per area %.4f, %.1f pairs\n",
                    shape, kind.name, static_cast<long long>(seen == &coarse ? kind.coarse : kind.fine), seen->least,
                    seen->most, seen->mean_least, seen->mean_most, seen->per_area, seen->pairs);
    expect_below(coarse.error(), 0.03, "rate of a point, coarse mesh");
    expect_below(fine.error(), 0.03, "rate of a point, fine mesh");
    expect_below(fine.error(), coarse.error(), "the finer mesh is closer");
    expect_near(coarse.per_area, 1.0, 0.02, 1.0, "dissipated per area, coarse mesh");
    expect_near(fine.per_area, 1.0, 0.01, 1.0, "dissipated per area, fine mesh");
}

// The cells along the growth are those of which the finer mesh is within 3 % of the toughness everywhere.
constexpr Kind straight_kinds[] = {
    {"hex8", DELAM_HEX8, 60, 90}, {"hex20", DELAM_HEX20, 30, 45}, {"tet10", DELAM_TET10, 30, 45}};
constexpr Kind circular_kinds[] = {
    {"hex8", DELAM_HEX8, 32, 40}, {"hex20", DELAM_HEX20, 15, 20}, {"tet10", DELAM_TET10, 13, 20}};

inline void grow_straight(const Kind& kind) {
    judge("straight", kind, analyse(straight(kind, kind.coarse), gc, 0.4), analyse(straight(kind, kind.fine), gc, 0.4));
}

inline void grow_circular(const Kind& kind) {
    judge("circular", kind, analyse(circular(kind, kind.coarse), blister_gc, 0.6),
          analyse(circular(kind, kind.fine), blister_gc, 0.6));
}

}  // namespace growing_fronts
