// SPDX-License-Identifier: BSD-3-Clause
// Small scenes with nodes without cells in their constraints, with periods, obstacles, faces that do not match.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "condensed_scenes.hpp"

namespace cases {

// Coefficients of one component of each node.
inline std::vector<double> components(int d, const std::vector<std::pair<int, double>>& list) {
    std::vector<double> c(list.size() * static_cast<std::size_t>(d), 0.0);
    for (std::size_t i = 0; i < list.size(); ++i)
        c[i * static_cast<std::size_t>(d) + static_cast<std::size_t>(list[i].first)] = list[i].second;
    return c;
}

// Two plies and nodes without cells, 0, 1, ..., for use in constraints.
inline Scene plies_with_controls(int d, int controls, const Map& map = nullptr) {
    Scene scene = make_blocks(
        d, {{{0.0, 0.0, 0.0}, {0.04, 0.003, 0.01}, {10, 1, 2}}, {{0.0, 0.003, 0.0}, {0.04, 0.006, 0.01}, {10, 1, 2}}},
        map, controls);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, 70e9, 0.3);
    scene.law(0, block_law);
    return scene;
}
inline std::vector<std::int64_t> body_nodes_where(const Scene& scene,
                                                  const std::function<bool(const double*)>& wanted) {
    return nodes_where(scene, -1, [&](const double* x) { return x[0] < 1.0 && wanted(x); });
}
inline void clamp_left(Scene& scene) {
    for (int k = 0; k < scene.dimension(); ++k)
        scene.hold(body_nodes_where(scene, [](const double* x) { return x[0] < 1e-6; }), unit(scene.dimension(), k));
}

// A rigid nose on the upper face: its nodes share the height of control node 0, which is moved or loaded by a dead
// force.
inline Scene make_nose(int d, bool dead) {
    Scene scene = plies_with_controls(d, 1);
    clamp_left(scene);
    for (const auto n : body_nodes_where(scene, [](const double* x) { return x[0] > 0.03 && x[1] > 0.0059; }))
        scene.equation({n, 0}, components(d, {{1, 2.0}, {1, -2.0}}));
    for (int k = 0; k < d; ++k)
        if (k != 1) scene.hold({0}, unit(d, k));
    if (dead)
        forces(scene, to_and_fro(scene, "load", 2e3), {0}, unit(d, 1));
    else
        scene.drive({0}, unit(d, 1), to_and_fro(scene, "load", 1e-5), {1.0});
    return scene;
}

// A lever: the weighted mean heights of two patches are moved together (one long equation); control node 0 measures one
// of them.
inline Scene make_lever(int d) {
    Scene scene = plies_with_controls(d, 1);
    clamp_left(scene);
    const auto tip = body_nodes_where(scene, [](const double* x) { return x[0] > 0.027; });
    const auto middle =
        body_nodes_where(scene, [](const double* x) { return x[0] > 0.013 && x[0] < 0.021 && x[1] > 0.0059; });
    std::vector<std::int64_t> nodes(tip);
    std::vector<std::pair<int, double>> c(tip.size(), {1, -0.7 / static_cast<double>(tip.size())});
    nodes.insert(nodes.end(), middle.begin(), middle.end());
    c.insert(c.end(), middle.size(), {1, 1.7 / static_cast<double>(middle.size())});
    scene.equation(nodes, components(d, c), to_and_fro(scene, "lever", 4e-6), 1.0);
    nodes = tip;
    nodes.push_back(0);
    c.assign(tip.size(), {1, 1.0 / static_cast<double>(tip.size())});
    c.push_back({1, -1.0});
    scene.equation(nodes, components(d, c));
    for (int k = 0; k < d; ++k)
        if (k != 1) scene.hold({0}, unit(d, k));
    forces(scene, to_and_fro(scene, "dead", 30.0), {0}, unit(d, 1));
    return scene;
}

// The right end of both plies is rigid: it moves with control node 0 and rotates with control node 1 (x: the angle
// times an arm), so that the jumps there depend on each other. 0 is moved across, the rotation is free.
inline Scene make_rigid_end(int d, const Map& map) {
    Scene scene = plies_with_controls(d, 2, map);
    const auto left = [&](const double* x) {
        return x[0] < 1.0 && (map ? 0.8 * x[0] + 0.35 * x[1] < 1e-6 : x[0] < 1e-6);
    };
    for (int k = 0; k < d; ++k) scene.hold(nodes_where(scene, -1, left), unit(d, k));
    const double end = map ? 0.9 * 0.8 * 0.04 + 0.35 * 0.4 * 0.04 : 0.04;
    for (const auto n : body_nodes_where(
             scene, [&](const double* x) { return (map ? 0.8 * x[0] + 0.35 * x[1] : x[0]) > end - 1e-6; })) {
        const double x = (scene.coordinate(n, 0) - 0.035) / 0.01, y = (scene.coordinate(n, 1) - 0.01) / 0.01;
        scene.equation({n, 0, 1}, components(d, {{0, 1.0}, {0, -1.0}, {0, y}}));
        scene.equation({n, 0, 1}, components(d, {{1, 1.0}, {1, -1.0}, {0, -x}}));
        if (d == 3) scene.equation({n, 0}, components(d, {{2, 1.0}, {2, -1.0}}));
    }
    scene.drive({0}, unit(d, 1), to_and_fro(scene, "shear", 1e-5), {1.0});
    scene.hold({1}, unit(d, 1));
    if (d == 3) scene.hold({1}, unit(d, 2));
    return scene;
}

// Chains of equations between neighbours and across the interface, one of them with a prescribed difference.
inline Scene make_chains(int d) {
    Scene scene = plies_with_controls(d, 0);
    clamp_left(scene);
    const auto top = body_nodes_where(scene, [](const double* x) { return x[0] > 0.019 && x[1] > 0.0059; });
    for (std::size_t i = 0; i + 1 < top.size(); ++i)
        scene.equation({top[i], top[i + 1]}, components(d, {{1, 1.0}, {1, -1.0}}));
    const auto pairs = scene.pairs(0);
    const auto load = to_and_fro(scene, "slide", 2e-6);
    for (std::size_t p = pairs.count() - 5; p < pairs.count(); ++p)
        scene.equation({pairs.node_a[p], pairs.node_b[p], top.front()},
                       components(d, {{0, 1.0}, {0, -1.0}, {0, p % 2 == 0 ? 0.3 : 0.0}}), load, 1.0);
    scene.drive({top.back()}, unit(d, 1), to_and_fro(scene, "lift", 5e-6), {1.0});
    return scene;
}

// A periodic cell of plies whose interface is cut by two faces; the strain along the plies is prescribed, the shear is
// free, and dead forces drive the rest.
inline Scene make_periodic_plies(int d, bool dead) {
    Scene scene = plies_with_controls(d, d - 1);
    std::vector<double> periods(static_cast<std::size_t>((d - 1) * d), 0.0);
    std::vector<std::int64_t> controls{0};
    periods[0] = 0.04;
    if (d == 3) {
        periods[5] = 0.01;
        controls.push_back(1);
    }
    scene.periodic(periods, controls);
    const auto inside = [d](const double* x) {
        return d == 2 || x[2] < 0.009;
    };  // otherwise the opposite side would be prescribed twice
    const auto bottom = body_nodes_where(
        scene, [&](const double* x) { return x[1] < 1e-6 && x[0] > 0.015 && x[0] < 0.033 && inside(x); });
    for (int k = 0; k < d; ++k) scene.hold(bottom, unit(d, k));
    if (d == 3) {
        for (int k = 0; k < 3; ++k) scene.hold({1}, unit(3, k));
    }
    if (dead) {
        forces(scene, to_and_fro(scene, "stress", 2e3), {0}, unit(d, 0));
    } else {
        scene.drive({0}, unit(d, 0), to_and_fro(scene, "strain", 4e-6), {1.0});
    }
    const auto top = body_nodes_where(
        scene, [&](const double* x) { return x[1] > 0.0059 && x[0] > 0.001 && x[0] < 0.01 && inside(x); });
    scene.drive(top, unit(d, 1), to_and_fro(scene, "lift", 2e-6), std::vector<double>(top.size(), 1.0));
    return scene;
}

// An interface without adhesion beside one with it.
inline Scene make_unglued(int d) {
    Scene scene = make_blocks(d, {{{0.0, 0.0, 0.0}, {0.04, 0.003, 0.01}, {10, 1, 2}},
                                  {{0.0, 0.003, 0.0}, {0.04, 0.006, 0.01}, {10, 1, 2}},
                                  {{0.0, 0.006, 0.0}, {0.04, 0.009, 0.01}, {10, 1, 2}}});
    scene.interface(0, 1);
    scene.interface(1, 2);
    scene.begin();
    scene.elastic(-1, 70e9, 0.3);
    scene.law(0, block_law);
    scene.contact(1);
    const auto left = nodes_where(scene, -1, [](const double* x) { return x[0] < 1e-6; });
    for (int k = 0; k < d; ++k) scene.hold(left, unit(d, k));
    const auto tip = nodes_where(scene, 2, [](const double* x) { return x[0] > 0.0399 && x[1] > 0.0089; });
    const auto load = to_and_fro(scene, "bend", 1e-5);
    scene.drive(tip, unit(d, 1), load, std::vector<double>(tip.size(), 1.0));
    const auto below = nodes_where(scene, 0, [](const double* x) { return x[0] > 0.0399 && x[1] < 1e-6; });
    scene.drive(below, unit(d, 1), load, std::vector<double>(below.size(), -0.5));
    return scene;
}

// Plies whose faces do not match: b's nodes are paired with projections on a. Periodic along x if requested, so that
// equations act on nodes to which others are tied. The middle ply is finer than its neighbours, so it is b once and a
// once.
inline Scene make_unmatched(int d, bool periodic) {
    Scene scene = make_blocks(d,
                              {{{0.0, 0.0, 0.0}, {0.04, 0.003, 0.01}, {7, 1, 2}},
                               {{0.0, 0.003, 0.0}, {0.04, 0.006, 0.01}, {11, 1, 3}},
                               {{0.0, 0.006, 0.0}, {0.04, 0.009, 0.01}, {10, 1, 2}}},
                              nullptr, 1);
    scene.projected(0, 1);
    scene.projected(1, 2);
    scene.begin();
    scene.elastic(-1, 70e9, 0.3);
    scene.elastic(1, 20e9, 0.2);
    for (int i = 0; i < 2; ++i) scene.law(i, block_law);
    const auto load = to_and_fro(scene, "pull", 4e-6);
    if (periodic) {
        std::vector<double> period(static_cast<std::size_t>(d), 0.0);
        period[0] = 0.04;
        scene.periodic(period, {0});
        scene.drive({0}, unit(d, 0), load, {1.0});
        for (int k = 1; k < d; ++k) scene.hold({0}, unit(d, k));
        const auto held =
            body_nodes_where(scene, [](const double* x) { return x[1] < 1e-6 && x[0] > 0.01 && x[0] < 0.03; });
        for (int k = 0; k < d; ++k) scene.hold(held, unit(d, k));
    } else {
        clamp_left(scene);
        const auto tip = body_nodes_where(scene, [](const double* x) { return x[0] > 0.0399 && x[1] < 1e-6; });
        scene.drive(tip, unit(d, 0), load, std::vector<double>(tip.size(), 1.0));
    }
    const auto top =
        body_nodes_where(scene, [](const double* x) { return x[1] > 0.0089 && x[0] > 0.031 && x[0] < 0.0399; });
    scene.drive(top, unit(d, 1), to_and_fro(scene, "bend", 5e-6), std::vector<double>(top.size(), 1.0));
    return scene;
}

// Two bonded plies between obstacles: one below that is at rest, one above that a pattern or a dead force moves.
inline Scene make_obstacles(int d, bool dead) {
    Scene scene = make_blocks(
        d, {{{0.0, 0.0, 0.0}, {0.04, 0.003, 0.01}, {10, 1, 2}}, {{0.0, 0.003, 0.0}, {0.04, 0.006, 0.01}, {10, 1, 2}}},
        nullptr, 2);
    scene.interface(0, 1);
    const auto below =
        body_nodes_where(scene, [](const double* x) { return x[1] < 1e-6 && x[0] > 0.0119 && x[0] < 0.0281; });
    const auto above = body_nodes_where(scene, [](const double* x) { return x[1] > 0.0059 && x[0] > 0.0279; });
    const auto normals = [d](std::size_t n, double sign) {
        std::vector<double> list(n * static_cast<std::size_t>(d), 0.0);
        for (std::size_t i = 0; i < n; ++i) list[i * static_cast<std::size_t>(d) + 1] = sign;
        return list;
    };
    scene.obstacle(below, normals(below.size(), 1.0), 0);
    scene.obstacle(above, normals(above.size(), -1.0), 1);
    scene.begin();
    scene.elastic(-1, 70e9, 0.3);
    scene.law(0, block_law);
    scene.contact(1);
    scene.contact(2);
    clamp_left(scene);
    for (int k = 0; k < d; ++k) {
        scene.hold({0}, unit(d, k));
        if (k != 1) scene.hold({1}, unit(d, k));
    }
    if (dead)
        forces(scene, scene.pattern("press", {-1.0, 0.0, 1.0}, {-2e3, -1e2, -2e3}), {1}, unit(d, 1));
    else
        scene.drive({1}, unit(d, 1), scene.pattern("press", {-1.0, 0.0, 1.0}, {-1e-5, 0.0, -2e-5}), {1.0});
    const auto tip = body_nodes_where(scene, [](const double* x) { return x[0] > 0.0399 && x[1] < 1e-6; });
    scene.drive(tip, unit(d, 0), to_and_fro(scene, "slide", 2e-6), std::vector<double>(tip.size(), 1.0));
    return scene;
}

}  // namespace cases
