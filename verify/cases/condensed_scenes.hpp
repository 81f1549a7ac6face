// SPDX-License-Identifier: BSD-3-Clause
// Small scenes of all shapes for the reductions: blocks that meet in lines and points, means, inclined and redundant
// supports, prescribed jumps, new elements. Loads go from -1 to 1 with time.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "api.hpp"

namespace cases {

using reference::LawData;
using reference::Scene;

inline constexpr LawData block_law{2e12, 1e12, 150.0, 200.0, 300.0, 500.0};

// One body: a box with a regular grid.
struct Block {
    std::array<double, 3> lower, upper;
    std::array<int, 3> cells;
};

using Map = std::function<std::array<double, 3>(const std::array<double, 3>&)>;

// Standard nodes of quad4 or hex8 blocks, moved by `map`; `loose` nodes belong to no cell. together: one body, each
// block with nodes of its own.
inline Scene make_blocks(int d, const std::vector<Block>& blocks, const Map& map = nullptr, int loose = 0,
                         bool together = false) {
    std::vector<double> nodes;
    std::vector<std::int64_t> cells;
    std::vector<std::int32_t> bodies;
    const auto push = [&](std::array<double, 3> x) {
        if (map) x = map(x);
        nodes.insert(nodes.end(), x.begin(), x.begin() + d);
    };
    for (int i = 0; i < loose; ++i) push({7.0 + i, 3.0, 1.0});
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        const Block& k = blocks[b];
        const auto first = static_cast<std::int64_t>(nodes.size()) / d;
        const int nx = k.cells[0], ny = k.cells[1], nz = d == 3 ? k.cells[2] : 0;
        for (int z = 0; z <= nz; ++z)
            for (int y = 0; y <= ny; ++y)
                for (int x = 0; x <= nx; ++x)
                    push({k.lower[0] + (k.upper[0] - k.lower[0]) * x / nx,
                          k.lower[1] + (k.upper[1] - k.lower[1]) * y / ny,
                          d == 3 ? k.lower[2] + (k.upper[2] - k.lower[2]) * z / nz : 0.0});
        const auto at = [&](int x, int y, int z) {
            return first + x + static_cast<std::int64_t>(nx + 1) * (y + static_cast<std::int64_t>(ny + 1) * z);
        };
        for (int z = 0; z < (d == 3 ? nz : 1); ++z)
            for (int y = 0; y < ny; ++y)
                for (int x = 0; x < nx; ++x) {
                    for (int up = 0; up < d - 1; ++up)
                        cells.insert(cells.end(), {at(x, y, z + up), at(x + 1, y, z + up), at(x + 1, y + 1, z + up),
                                                   at(x, y + 1, z + up)});
                    bodies.push_back(together ? 0 : static_cast<std::int32_t>(b));
                }
    }
    return Scene(d, nodes, d == 2 ? DELAM_QUAD4 : DELAM_HEX8, cells, bodies);
}

// Nodes of a body (-1: all) that satisfy a condition on their coordinates before the map.
inline std::vector<std::int64_t> nodes_where(const Scene& scene, std::int32_t body,
                                             const std::function<bool(const double*)>& wanted) {
    const std::vector<double> far(static_cast<std::size_t>(scene.dimension()), 1e3);
    std::vector<double> low(far);
    for (double& v : low) v = -v;
    std::vector<std::int64_t> found;
    for (const auto n : scene.find(body, low, far))
        if (wanted(&scene.nodes()[static_cast<std::size_t>(n * scene.dimension())])) found.push_back(n);
    return found;
}

inline std::vector<double> unit(int d, int k, double sign = 1.0) {
    std::vector<double> e(static_cast<std::size_t>(d), 0.0);
    e[static_cast<std::size_t>(k)] = sign;
    return e;
}

inline void mean(Scene& scene, const std::vector<std::int64_t>& nodes, const std::vector<double>& weights,
                 const std::vector<double>& direction, std::int64_t pattern, double coefficient) {
    REQUIRE(scene, delam_problem_prescribe_mean, scene.problem(), static_cast<std::int64_t>(nodes.size()), nodes.data(),
            weights.data(), direction.data(), pattern < 0 ? 0 : 1, &pattern, &coefficient, 0);
}

inline void forces(Scene& scene, std::int64_t pattern, const std::vector<std::int64_t>& nodes,
                   const std::vector<double>& values) {
    REQUIRE(scene, delam_problem_add_forces, scene.problem(), pattern, static_cast<std::int64_t>(nodes.size()),
            nodes.data(), values.data(), 0);
}

inline std::int64_t to_and_fro(Scene& scene, const char* name, double size) {
    return scene.pattern(name, {-1.0, 0.0, 1.0}, {-size, 0.0, size});
}

// Two or more plies, held at the left end; the right end is moved along and across: opens, slides and presses.
inline Scene make_plies(int d, int count, std::int32_t cell, const char* formulation, const LawData& law,
                        int along = 12, int through = 1) {
    constexpr double length = 0.04, width = 0.01, ply = 0.003;
    Scene scene(d, d == 2 ? std::vector<double>{length} : std::vector<double>{length, width},
                d == 2 ? std::vector<std::int64_t>{along} : std::vector<std::int64_t>{along, 2},
                std::vector<double>(static_cast<std::size_t>(count), ply),
                std::vector<std::int64_t>(static_cast<std::size_t>(count), through), cell);
    for (int i = 0; i + 1 < count; ++i) scene.interface(i, i + 1);
    scene.begin();
    scene.elastic(-1, 70e9, 0.3);
    scene.require(delam_problem_set_formulation(scene.problem(), -1, formulation), "formulation");
    for (int i = 0; i + 1 < count; ++i) scene.law(i, law);
    const auto left = nodes_where(scene, -1, [](const double* x) { return x[0] < 1e-6; });
    for (int k = 0; k < d; ++k) scene.hold(left, unit(d, k));
    const auto load = to_and_fro(scene, "bend", 1e-5);
    const auto slide = to_and_fro(scene, "slide", 3e-6);
    const auto top = nodes_where(
        scene, count - 1, [&](const double* x) { return x[0] > length - 1e-6 && x[d - 1] > count * ply - 1e-6; });
    scene.drive(top, unit(d, d - 1), load, std::vector<double>(top.size(), 1.0));
    scene.drive(top, unit(d, 0), slide, std::vector<double>(top.size(), -1.0));
    const auto bottom = nodes_where(scene, 0, [&](const double* x) { return x[0] > length - 1e-6 && x[d - 1] < 1e-6; });
    scene.drive(bottom, unit(d, d - 1), load, std::vector<double>(bottom.size(), -0.4));
    return scene;
}

inline Map inclined() {
    return [](const std::array<double, 3>& x) {
        return std::array<double, 3>{0.9 * x[0] - 0.35 * x[1], 0.4 * x[0] + 0.8 * x[1], x[2] + 0.1 * x[0]};
    };
}

// Holds the nodes where `low`, moves those where `high`, all components.
inline void clamp_and_pull(Scene& scene, const std::function<bool(const double*)>& low,
                           const std::function<bool(const double*)>& high, double size) {
    const int d = scene.dimension();
    const auto held = nodes_where(scene, -1, low);
    for (int k = 0; k < d; ++k) scene.hold(held, unit(d, k));
    const auto load = to_and_fro(scene, "pull", size);
    const auto moved = nodes_where(scene, -1, high);
    std::vector<double> lift, slide, across;
    for (const auto n : moved) {
        lift.push_back(1.0 + 40.0 * scene.coordinate(n, 0));
        slide.push_back(scene.coordinate(n, 0) < 0.0 ? -0.7 : 0.3);
        across.push_back(20.0 * scene.coordinate(n, 1));
    }
    scene.drive(moved, unit(d, 1), load, lift);
    scene.drive(moved, unit(d, 0), load, slide);
    if (d == 3) scene.drive(moved, unit(3, 2), load, across);
}

constexpr double edge = 0.01;

// A wide block below and two on top of it that touch: three interfaces with a common point (2D) or line (3D).
inline Scene make_tee(int d, bool slanted, int bonded) {
    const int n = d == 2 ? 4 : 2;
    Scene scene = make_blocks(d,
                              {{{-edge, -edge, 0.0}, {edge, 0.0, edge}, {2 * n, n, n}},
                               {{-edge, 0.0, 0.0}, {0.0, edge, edge}, {n, n, n}},
                               {{0.0, 0.0, 0.0}, {edge, edge, edge}, {n, n, n}}},
                              slanted ? inclined() : Map());
    scene.interface(0, 1);
    scene.interface(0, 2);
    scene.interface(1, 2);
    scene.begin();
    scene.elastic(-1, 70e9, 0.3);
    scene.elastic(1, 20e9, 0.2);
    for (int i = 0; i < 3; ++i) i == bonded ? scene.bonded(i) : scene.law(i, block_law);
    const auto height = [slanted](const double* x) {
        // inverse of the map in the plane
        return slanted ? (0.9 * x[1] - 0.4 * x[0]) / (0.9 * 0.8 + 0.35 * 0.4) : x[1];
    };
    clamp_and_pull(
        scene, [=](const double* x) { return height(x) < -edge + 1e-6; },
        [=](const double* x) { return height(x) > edge - 1e-6; }, 1e-6);
    return scene;
}

// Four blocks around a point or line. bonded: bit mask of interfaces.
inline Scene make_cross(int d, bool slanted, unsigned bonded, int loose = 0) {
    const int n = d == 2 ? 4 : 2;
    std::vector<Block> blocks;
    for (int b = 0; b < 4; ++b) {
        const double x = b % 2 == 0 ? -edge : 0.0, y = b / 2 == 0 ? -edge : 0.0;
        blocks.push_back({{x, y, 0.0}, {x + edge, y + edge, edge}, {n, n, n}});
    }
    Scene scene = make_blocks(d, blocks, slanted ? inclined() : Map(), loose);
    for (const auto& [a, b] : {std::pair{0, 1}, {2, 3}, {0, 2}, {1, 3}}) scene.interface(a, b);
    scene.begin();
    scene.elastic(-1, 70e9, 0.3);
    for (int i = 0; i < 4; ++i) (bonded >> i & 1U) != 0 ? scene.bonded(i) : scene.law(i, block_law);
    const auto height = [slanted](const double* x) {
        return slanted ? (0.9 * x[1] - 0.4 * x[0]) / (0.9 * 0.8 + 0.35 * 0.4) : x[1];
    };
    clamp_and_pull(
        scene, [=](const double* x) { return height(x) < -edge + 1e-6; },
        [=](const double* x) { return height(x) > edge - 1e-6 && std::abs(x[0]) < 5 * edge; }, 1e-6);
    return scene;
}

// Two plies made of blocks, so that coordinates may be rotated: the base of the constraint scenes.
inline Scene two_plies(int d, const Map& map, int along = 10) {
    Scene scene = make_blocks(d,
                              {{{0.0, 0.0, 0.0}, {0.04, 0.003, 0.01}, {along, 1, 2}},
                               {{0.0, 0.003, 0.0}, {0.04, 0.006, 0.01}, {along, 1, 2}}},
                              map);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, 70e9, 0.3);
    scene.law(0, block_law);
    return scene;
}

// Means over patches, and in addition some of their nodes one by one.
inline Scene make_means(int d) {
    Scene scene = two_plies(d, nullptr);
    const auto left = nodes_where(scene, -1, [](const double* x) { return x[0] < 0.006; });
    const auto load = to_and_fro(scene, "lift", 5e-6);
    std::vector<double> weights;
    for (std::size_t i = 0; i < left.size(); ++i) weights.push_back(1.0 + 0.1 * static_cast<double>(i));
    for (int k = 0; k < d; ++k) mean(scene, left, weights, unit(d, k), -1, 0.0);
    const auto corner = nodes_where(scene, 0, [](const double* x) { return x[0] < 1e-6 && x[1] < 1e-6; });
    for (int k = 0; k < d; ++k) scene.hold(corner, unit(d, k));
    scene.hold(nodes_where(scene, 0, [](const double* x) { return x[0] > 1e-6 && x[0] < 0.0041 && x[1] < 1e-6; }),
               unit(d, 1));
    const auto tip = nodes_where(scene, 1, [](const double* x) { return x[0] > 0.035; });
    mean(scene, tip, std::vector<double>(tip.size(), 1.0), unit(d, 1), load, 1.0);
    mean(scene, tip, std::vector<double>(tip.size(), 1.0), unit(d, 0), load, -0.3);
    return scene;
}

// Single nodes fixed along oblique directions, on faces of pairs too.
inline Scene make_slanted_supports(int d) {
    Scene scene = two_plies(d, nullptr);
    const auto left = nodes_where(scene, 0, [](const double* x) { return x[0] < 1e-6; });
    std::vector<double> a = unit(d, 0), b = unit(d, 1);
    a[1] = 0.5;
    b[0] = -0.3;
    scene.hold(left, a);
    scene.hold(left, b);
    if (d == 3) scene.hold(left, {0.2, 0.3, 1.0});
    const auto load = to_and_fro(scene, "lift", 5e-6);
    const auto tip = nodes_where(scene, 1, [](const double* x) { return x[0] > 0.0399; });
    scene.drive(tip, b, load, std::vector<double>(tip.size(), 1.0));
    return scene;
}

// Opened at the faces of the first pairs: these jumps are prescribed. turn: in degrees.
inline Scene make_opened(int d, double turn) {
    const double c = std::cos(turn * M_PI / 180.0), s = std::sin(turn * M_PI / 180.0);
    Scene scene = two_plies(d, [=](const std::array<double, 3>& x) {
        return std::array<double, 3>{c * x[0] - s * x[1], s * x[0] + c * x[1], x[2]};
    });
    const auto along = [=](const double* x) { return c * x[0] + s * x[1]; };
    const auto pairs = scene.pairs(0);
    std::vector<std::int64_t> notch, lower, upper;
    for (std::size_t p = 0; p < pairs.count(); ++p) {
        const double* x = &scene.nodes()[static_cast<std::size_t>(pairs.node_a[p] * d)];
        if (along(x) > 0.009) continue;
        notch.push_back(static_cast<std::int64_t>(p));
        if (along(x) > 1e-6) continue;
        lower.push_back(pairs.node_a[p]);
        upper.push_back(pairs.node_b[p]);
    }
    scene.adhesion(0, notch, std::vector<double>(notch.size(), 0.0));
    std::vector<double> up = unit(d, 0), out = unit(d, 0);
    up[0] = -s;
    up[1] = c;
    out[0] = c;
    out[1] = s;
    const auto end = nodes_where(scene, -1, [=](const double* x) { return along(x) > 0.0399; });
    for (int k = 0; k < d; ++k) scene.hold(end, unit(d, k));
    const auto load = scene.pattern("open", {0.0, 1.0}, {0.0, 4e-5});
    scene.drive(upper, up, load, std::vector<double>(upper.size(), 0.5));
    scene.drive(lower, up, load, std::vector<double>(lower.size(), -0.5));
    scene.hold(upper, out);
    scene.hold(lower, out);
    return scene;
}

// The lower nodes of two pairs are fixed, their upper nodes moved by their mean: one row binds two jumps, another four.
inline Scene make_bound_jumps(int d) {
    Scene scene = two_plies(d, nullptr);
    const auto pairs = scene.pairs(0);
    std::vector<std::int64_t> a, b;
    for (std::size_t p = 0; p < pairs.count(); ++p) {
        const double x = scene.coordinate(pairs.node_a[p], 0);
        if (x < 0.0099 || x > 0.0281) continue;
        a.push_back(pairs.node_a[p]);
        b.push_back(pairs.node_b[p]);
    }
    for (int k = 0; k < d; ++k) scene.hold(a, unit(d, k));
    const auto load = scene.pattern("open", {-1.0, 0.0, 1.0}, {4e-6, 0.0, 4e-6});
    mean(scene, {b[0], b[1]}, {1.0, 2.0}, unit(d, 1), load, 1.0);
    mean(scene, {b[0], b[1], b[2], b[3]}, {1.0, 2.0, 1.0, 1.0}, unit(d, 0), load, -0.5);
    const auto tip = nodes_where(scene, 1, [](const double* x) { return x[0] > 0.0399; });
    scene.drive(tip, unit(d, 1), to_and_fro(scene, "bend", 5e-6), std::vector<double>(tip.size(), -1.0));
    return scene;
}

// The same on an inclined face by single nodes: the lower ones are fixed, the upper ones lifted but free across.
inline Scene make_bound_slip(int d) {
    Scene scene = two_plies(d, inclined());
    const auto pairs = scene.pairs(0);
    const std::vector<std::int64_t> a(pairs.node_a.begin(), pairs.node_a.begin() + 4);
    const std::vector<std::int64_t> b(pairs.node_b.begin(), pairs.node_b.begin() + 4);
    for (int k = 0; k < d; ++k) scene.hold(a, unit(d, k));
    const auto load = scene.pattern("lift", {-1.0, 0.0, 1.0}, {4e-6, 0.0, 4e-6});
    scene.drive(b, unit(d, 1), load, {1.0, 2.0, 1.0, 1.0});
    return scene;
}

// Permanently bonded, with both nodes of some pairs fixed: supports that follow from each other through the bond.
inline Scene make_redundant(int d) {
    Scene scene = make_blocks(d,
                              {{{0.0, 0.0, 0.0}, {0.04, 0.003, 0.01}, {10, 1, 2}},
                               {{0.0, 0.003, 0.0}, {0.04, 0.006, 0.01}, {10, 1, 2}},
                               {{0.0, 0.006, 0.0}, {0.04, 0.009, 0.01}, {10, 1, 2}}},
                              inclined());
    scene.interface(0, 1);
    scene.interface(1, 2);
    scene.begin();
    scene.elastic(-1, 70e9, 0.3);
    scene.bonded(0);
    scene.law(1, block_law);
    std::vector<std::int64_t> both;
    const auto pairs = scene.pairs(0);
    for (std::size_t p = 0; p < 9; ++p) {
        both.push_back(pairs.node_a[p]);
        both.push_back(pairs.node_b[p]);
    }
    for (int k = 0; k < d; ++k) scene.hold(both, unit(d, k));
    const auto moved = scene.pairs(1).node_b.back();
    scene.drive({moved}, unit(d, 1), to_and_fro(scene, "bend", 5e-6), {1.0});
    return scene;
}

// Dead forces on the upper ply.
inline Scene make_forces(int d) {
    Scene scene = two_plies(d, nullptr);
    const auto bottom = nodes_where(scene, 0, [](const double* x) { return x[1] < 1e-6; });
    for (int k = 0; k < d; ++k) scene.hold(bottom, unit(d, k));
    const auto top = nodes_where(scene, 1, [](const double* x) { return x[1] > 0.0059; });
    std::vector<double> values;
    for (std::size_t i = 0; i < top.size(); ++i) {
        values.push_back(0.1 * static_cast<double>(i));
        values.push_back(i % 2 == 0 ? 1.0 : -0.4);
        if (d == 3) values.push_back(0.3);
    }
    forces(scene, to_and_fro(scene, "dead", 1e3), top, values);
    return scene;
}

}  // namespace cases
