// SPDX-License-Identifier: BSD-3-Clause
// Fronts in space that grow, on two meshes each: the energy release rate of every point and what growth dissipates per
// area are the toughness, on straight and on circular fronts; a slab has the rates of the strip in the plane.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "front_points.hpp"
#include "support.hpp"

using namespace cases;

namespace {

constexpr double young = 70e9;

struct Kind {
    const char* name;
    std::int32_t cell;
    std::int64_t coarse, fine;  // cells along the growth
};

// What is seen while a front grows: rates of single points, energy per area, both over the toughness.
struct Seen {
    double least = 1e300, most = 0.0, mean_least = 1e300, mean_most = 0.0, per_area = 0.0, pairs = 1e300;
    double error() const { return std::max(most - 1.0, 1.0 - least); }
};

std::vector<double> along(int axis) {
    std::vector<double> direction(3, 0.0);
    direction[static_cast<std::size_t>(axis)] = 1.0;
    return direction;
}

void open(reference::Scene& scene, double radius, bool circular) {
    const reference::Pairs pairs = scene.pairs(0);
    std::vector<std::int64_t> notch;
    for (std::size_t p = 0; p < pairs.count(); ++p) {
        const double x = scene.coordinate(pairs.node_a[p], 0), y = scene.coordinate(pairs.node_a[p], 1);
        if ((circular ? std::hypot(x, y) : x) < radius - 1e-9) notch.push_back(static_cast<std::int64_t>(p));
    }
    scene.adhesion(0, notch, std::vector<double>(notch.size(), 0.0));
}

reference::Scene begin(const Kind& kind, const std::vector<double>& lengths, const std::vector<std::int64_t>& cells,
                       const std::vector<double>& thickness, const std::vector<std::int64_t>& through, double poisson,
                       const reference::LawData& law) {
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
reference::Scene straight(const Kind& kind, std::int64_t cells) {
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
reference::Scene circular(const Kind& kind, std::int64_t cells) {
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

Seen analyse(reference::Scene scene, double toughness, double from) {
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

void judge(const char* shape, const Kind& kind, const Seen& coarse, const Seen& fine) {
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

}  // namespace

LOOP_TEST(straight_front_grows, 0, 3) {
    constexpr Kind kinds[] = {
        {"hex8", DELAM_HEX8, 60, 90}, {"hex20", DELAM_HEX20, 30, 45}, {"tet10", DELAM_TET10, 30, 45}};
    const Kind kind = kinds[loop];
    judge("straight", kind, analyse(straight(kind, kind.coarse), gc, 0.4), analyse(straight(kind, kind.fine), gc, 0.4));
}

LOOP_TEST(circular_front_grows, 0, 3) {
    constexpr Kind kinds[] = {
        {"hex8", DELAM_HEX8, 32, 40}, {"hex20", DELAM_HEX20, 15, 20}, {"tet10", DELAM_TET10, 13, 20}};
    const Kind kind = kinds[loop];
    judge("circular", kind, analyse(circular(kind, kind.coarse), blister_gc, 0.6),
          analyse(circular(kind, kind.fine), blister_gc, 0.6));
}

// One arm is pulled, so that the front grows in mixed mode: one cell of hex20 across the width against quad8.
TEST(slab_of_quadratic_cells) {
    const double length = 60e-3, width = 1e-3, arm = 2e-3, end = 2.5e-3;
    double load[2] = {0, 0}, rate[2] = {0, 0}, mixity[2] = {0, 0}, area[2] = {0, 0};
    for (const int d : {2, 3}) {
        const bool solid = d == 3;
        reference::Scene scene(d, solid ? std::vector<double>{length, width} : std::vector<double>{length},
                               solid ? std::vector<std::int64_t>{60, 1} : std::vector<std::int64_t>{60}, {arm, arm},
                               {2, 2}, solid ? DELAM_HEX20 : DELAM_QUAD8);
        scene.interface(0, 1);
        scene.begin();
        scene.elastic(-1, young, 0.3);
        scene.law(0, {1e14, 1e14, 1.125, 1.125, gc, gc, 1.0});
        open(scene, 15e-3, false);
        const auto line = [&](std::int32_t body, double x, double low, double high) {
            return solid ? scene.find(body, {x, 0.0, low}, {x, width, high}) : scene.find(body, {x, low}, {x, high});
        };
        const auto axis = [&](int k) {
            std::vector<double> direction(static_cast<std::size_t>(d), 0.0);
            direction[static_cast<std::size_t>(k)] = 1.0;
            return direction;
        };
        if (solid) scene.hold(scene.find(-1, {-1, -1, -1}, {1, 1, 1}), axis(1));
        for (const int k : {0, d - 1}) scene.hold(line(-1, length, 0.0, 2.0 * arm), axis(k));
        const auto pull = scene.pattern("pull", {0.0, 1.0}, {0.0, end});
        const auto nodes = line(1, 0.0, 2.0 * arm, 2.0 * arm);
        scene.drive(nodes, axis(d - 1), pull, std::vector<double>(nodes.size(), 1.0));
        scene.text("mixity_rule", "frozen");
        reference::Solver solver(scene, 0.0);
        for (int k = 1; k <= 16; ++k) {
            solver.step(k / 16.0);
            solver.commit();
        }
        const std::size_t i = solid ? 1 : 0;
        load[i] = solver.value("reaction:pull") / (solid ? width : 1.0);
        rate[i] = solver.value("energy_release_rate");
        mixity[i] = solver.value("front_mixity");
        area[i] = solver.value("crack_area") / (solid ? width : 1.0);
    }
    std::printf(
        "slab of hex20 / strip of quad8: load %.4f, G %.4f (%.4g J/m2), crack %.4f (%.4g mm), mixity %.3f, %.3f\n",
        load[1] / load[0], rate[1] / rate[0], rate[0], area[1] / area[0], 1e3 * area[0], mixity[1], mixity[0]);
    expect(area[0] > 20e-3, "it has grown");
    expect_near(load[1], load[0], 0.01, load[0], "load");
    expect_near(rate[1], rate[0], 0.03, rate[0], "largest rate of the slab");
    expect_near(mixity[1], mixity[0], 0.01, 1.0, "mixity");
    expect_near(area[1], area[0], 0.01, area[0], "length of the crack");
}
