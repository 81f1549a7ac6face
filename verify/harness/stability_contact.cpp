// SPDX-License-Identifier: BSD-3-Clause
// Stability of contact: plies held by contact alone or by nothing, faces that open and close in one step, cross points,
// redundant supports.
#include <algorithm>
#include <cmath>
#include <memory>

#include "stability.hpp"

namespace harness {
namespace {

using reference::LawData;
using reference::Scene;

constexpr double young = 70e9, length = 0.04, ply = 3e-3, press = 2e-6;
// Sliding takes no energy, so neither displacements nor slips are unique.
constexpr Compared sliding{false, false, true, true, true};

std::vector<std::int64_t> all_pairs(const Scene& scene, std::int64_t interface_index) {
    std::vector<std::int64_t> pairs(scene.pairs(interface_index).count());
    for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i] = static_cast<std::int64_t>(i);
    return pairs;
}

// `loose` plies without adhesion on a supported one; the top is pressed down in the middle by `push`. pinned: one node
// of each loose ply is held sideways, for the reference.
Scene plies(int loose, double push, bool pinned, double dead = 0.0) {
    const auto count = static_cast<std::size_t>(loose) + 1;
    Scene scene(2, {length}, {20}, std::vector<double>(count, ply), std::vector<std::int64_t>(count, 2), DELAM_QUAD4);
    for (std::int32_t i = 0; i < loose; ++i) scene.interface(i, i + 1);
    begin_standard(scene);
    scene.elastic(-1, young, 0.3);
    for (std::int64_t i = 0; i < loose; ++i) {
        scene.law(i, intact);
        const auto pairs = all_pairs(scene, i);
        scene.adhesion(i, pairs, std::vector<double>(pairs.size(), 0.0));
    }
    const auto bottom = scene.find(0, {0.0, 0.0}, {length, 0.0});
    scene.hold(bottom, {1.0, 0.0});
    scene.hold(bottom, {0.0, 1.0});
    const double top = ply * static_cast<double>(count);
    if (push != 0.0) {
        const auto nodes = scene.find(loose, {0.3 * length, top}, {0.6 * length, top});
        scene.drive(nodes, {0.0, 1.0}, scene.pattern("push", {0.0, 1.0}, {0.0, -push}),
                    std::vector<double>(nodes.size(), 1.0));
    }
    if (dead != 0.0) {
        const auto nodes = scene.find(loose, {0.3 * length, top}, {0.6 * length, top});
        std::vector<double> forces;
        for (std::size_t i = 0; i < nodes.size(); ++i) forces.insert(forces.end(), {0.0, 1.0});
        REQUIRE(scene, delam_problem_add_forces, scene.problem(), scene.pattern("dead", {0.0, 1.0}, {0.0, -dead}),
                static_cast<std::int64_t>(nodes.size()), nodes.data(), forces.data(), 0);
    }
    for (std::int32_t b = 1; b <= loose && pinned; ++b)
        scene.hold(scene.find(b, {0.0, (b + 0.5) * ply}, {0.0, (b + 0.5) * ply}), {1.0, 0.0});
    return scene;
}

void floating(Study& study) {
    for (const bool lifted : {false, true}) {
        const std::string subject = lifted ? "floating-lifted" : "floating-pressed";
        if (!study.wanted(subject)) continue;
        for (const double count : study.range({1, 2, 3, 4, 6, 8, 12, 16}, 4)) {
            const int loose = static_cast<int>(count);
            Trial t = trial_of(subject, "loose plies", count);
            t.subdomains = 2 * (loose + 1);
            t.scene = [=] { return plies(loose, lifted ? -press : press, false); };
            t.compared = sliding;
            if (lifted) {
                t.reference = "closed form (no stress)";
                t.error = [](const Result& r) { return largest(r.traction) / (young * press / ply); };
                t.direct = false;
                t.left_out = "its plies float freely";
                t.least_traction = young * press / ply;
                t.least_force = young * press;
                t.least_energy = young * press * press;
            } else {
                t.held = [=] { return plies(loose, press, true); };
                t.defect_limit = closed_balance;
            }
            study.run(t);
        }
    }
    // A dead load along a motion that only contact could resist is refused before the analysis.
    if (study.wanted("dead-load-on-loose-ply"))
        for (const double force : study.range({1e-12, 1e-6, 1, 1e6}, 3)) {
            Trial t = trial_of("dead-load-on-loose-ply", "force, N/m", force);
            t.scene = [=] { return plies(2, 0.0, false, force); };
            t.direct = false;
            t.refused = "missing support";
            study.run(t);
        }
    // A dead load that lifts an adhering ply, with more force than the bond can carry: at factor 1 it separates, and
    // there is no equilibrium.
    if (!study.wanted("dead-load-lifts")) return;
    for (const double part : study.range({1e-9, 1e-3, 0.5, 0.9, 0.999, 1.001, 1.1, 10, 1e6}, 3)) {
        const LawData law{1e13, 1e13, 50.0, 50.0, 200.0, 200.0};
        const double strength = std::sqrt(2.0 * law.normal_stiffness * law.normal_onset);
        Trial t = trial_of("dead-load-lifts", "load / strength", part);
        t.law = law;
        t.scene = [=] {
            Scene scene(2, {length}, {20}, {ply, ply}, {2, 2}, DELAM_QUAD4);
            scene.interface(0, 1);
            begin_standard(scene);
            // No Poisson effect: the traction is uniform.
            scene.elastic(-1, young, 0.0);
            scene.law(0, law);
            const auto bottom = scene.find(0, {0.0, 0.0}, {length, 0.0});
            scene.hold(bottom, {1.0, 0.0});
            scene.hold(bottom, {0.0, 1.0});
            const auto top = scene.find(1, {0.0, 2 * ply}, {length, 2 * ply});
            std::vector<double> forces;
            for (std::size_t i = 0; i < top.size(); ++i) {
                const double x = scene.coordinate(top[i], 0), h = length / 20;
                const bool end = x < 0.5 * h || x > length - 0.5 * h;
                forces.insert(forces.end(), {0.0, (end ? 0.5 : 1.0) * h * part * strength});
            }
            REQUIRE(scene, delam_problem_add_forces, scene.problem(), scene.pattern("dead", {0.0, 1.0}, {0.0, 1.0}),
                    static_cast<std::int64_t>(top.size()), top.data(), forces.data(), 0);
            return scene;
        };
        t.reference = "closed form (uniform tension)";
        t.error = [=](const Result& r) {
            double worst = 0.0;
            for (std::size_t i = 0; i < r.traction.size(); i += 2)
                worst = std::max({worst, std::abs(r.traction[i] / (part * strength) - 1.0),
                                  std::abs(r.traction[i + 1] / (part * strength))});
            return worst;
        };
        if (part > 1.0) {
            t.direct = false;
            t.refused = "no equilibrium";
        } else {
            t.defect_limit = closed_balance;
        }
        study.run(t);
    }
}

// A block in the corner of two rigid walls, pushed obliquely at the opposite corner: only contact holds it.
void corner(Study& study) {
    if (!study.wanted("held-by-contact")) return;
    for (const double degrees : study.range({1, 5, 15, 30, 45, 60, 75, 85, 89}, 4)) {
        Trial t = trial_of("held-by-contact", "direction, degrees", degrees);
        t.scene = [=] {
            constexpr std::int64_t n = 10;
            constexpr double side = 0.01;
            std::vector<double> nodes;
            for (std::int64_t j = 0; j <= n; ++j)
                for (std::int64_t i = 0; i <= n; ++i)
                    nodes.insert(nodes.end(), {side * static_cast<double>(i) / n, side * static_cast<double>(j) / n});
            const auto control = static_cast<std::int64_t>(nodes.size() / 2);
            nodes.insert(nodes.end(), {-side, -side});
            std::vector<std::int64_t> cells, below, left;
            for (std::int64_t j = 0; j < n; ++j)
                for (std::int64_t i = 0; i < n; ++i) {
                    const std::int64_t a = j * (n + 1) + i;
                    cells.insert(cells.end(), {a, a + 1, a + n + 2, a + n + 1});
                }
            for (std::int64_t i = 0; i <= n; ++i) below.push_back(i), left.push_back(i * (n + 1));
            const auto walls = [&](std::vector<double> normal) {
                std::vector<double> all;
                for (std::int64_t i = 0; i <= n; ++i) all.insert(all.end(), normal.begin(), normal.end());
                return all;
            };
            Scene scene(2, nodes, DELAM_QUAD4, cells, std::vector<std::int32_t>(static_cast<std::size_t>(n * n), 0));
            scene.obstacle(below, walls({0.0, 1.0}), control);
            scene.obstacle(left, walls({1.0, 0.0}), control);
            begin_standard(scene);
            scene.elastic(0, young, 0.3);
            scene.contact(0);
            scene.contact(1);
            scene.hold({control}, {1.0, 0.0});
            scene.hold({control}, {0.0, 1.0});
            const double angle = degrees * std::acos(-1.0) / 180.0;
            const std::int64_t far = (n + 1) * (n + 1) - 1;
            const std::vector<double> force{-std::cos(angle), -std::sin(angle)};
            REQUIRE(scene, delam_problem_add_forces, scene.problem(), scene.pattern("push", {0.0, 1.0}, {0.0, 1e5}), 1,
                    &far, force.data(), 0);
            return scene;
        };
        t.defect_limit = closed_balance;
        study.run(t);
    }
}

// A loose arm on another, both clamped: lifted at the end and pressed in the middle, then in one step the reverse, by
// `ratio` times as much. What was open closes, and what was closed opens.
void reversed(Study& study) {
    if (!study.wanted("open-and-close")) return;
    for (const double ratio : study.range({1e-6, 1e-4, 1e-2, 0.1, 0.5, 1, 2, 10, 1e2, 1e4, 1e6}, 5)) {
        Trial t = trial_of("open-and-close", "reverse / first load", ratio);
        t.times = {1.0, 2.0, 3.0};
        t.scene = [=] {
            Scene scene(2, {length}, {40}, {ply, ply}, {3, 3}, DELAM_QUAD4);
            scene.interface(0, 1);
            begin_standard(scene);
            scene.elastic(-1, young, 0.3);
            scene.law(0, intact);
            std::vector<std::int64_t> notch;
            for (std::int64_t i = 0; i < 35; ++i) notch.push_back(i);
            scene.adhesion(0, notch, std::vector<double>(notch.size(), 0.0));
            const auto right = scene.find(-1, {length, 0.0}, {length, 2 * ply});
            scene.hold(right, {1.0, 0.0});
            scene.hold(right, {0.0, 1.0});
            const double top = 2.0 * ply, w = 1e-5;
            const std::vector<double> times{0.0, 1.0, 2.0, 3.0}, values{0.0, w, -ratio * w, w};
            const auto load = scene.pattern("load", times, values);
            scene.drive(scene.find(1, {0.0, top}, {0.0, top}), {0.0, 1.0}, load, {1.0});
            scene.drive(scene.find(1, {0.5 * length, top}, {0.5 * length, top}), {0.0, 1.0}, load, {-0.5});
            return scene;
        };
        t.defect_limit = closed_balance;
        study.run(t);
    }
}

// Square blocks in rows and columns, with one node per block at every crossing.
Scene blocks(std::int64_t n, bool bonded, const char* gluing, bool twice) {
    const std::int64_t cells_a_side = 3 * n;
    const double side = 0.03, h = side / static_cast<double>(cells_a_side);
    std::vector<double> nodes;
    for (std::int64_t j = 0; j <= cells_a_side; ++j)
        for (std::int64_t i = 0; i <= cells_a_side; ++i)
            nodes.insert(nodes.end(), {h * static_cast<double>(i), h * static_cast<double>(j)});
    std::vector<std::int64_t> cells;
    std::vector<std::int32_t> bodies;
    for (std::int64_t j = 0; j < cells_a_side; ++j)
        for (std::int64_t i = 0; i < cells_a_side; ++i) {
            const std::int64_t a = j * (cells_a_side + 1) + i, up = a + cells_a_side + 1;
            cells.insert(cells.end(), {a, a + 1, up + 1, up});
            bodies.push_back(static_cast<std::int32_t>((j / 3) * n + i / 3));
        }
    Scene scene = Scene::conforming(2, nodes, DELAM_QUAD4, cells, bodies);
    const std::int64_t count = scene.all_interfaces();
    begin_standard(scene);
    scene.elastic(-1, young, 0.3);
    for (std::int64_t i = 0; i < count; ++i)
        if (bonded)
            scene.bonded(i);
        else
            scene.law(i, intact);
    const auto bottom = scene.find(-1, {0.0, 0.0}, {side, 0.0}), top = scene.find(-1, {0.0, side}, {side, side});
    for (int round = 0; round < (twice ? 2 : 1); ++round) {
        scene.hold(bottom, {1.0, 0.0});
        scene.hold(bottom, {0.0, 1.0});
    }
    const auto load = scene.pattern("pull", {0.0, 1.0}, {0.0, 1e-5});
    // Rotated while pulled, so that some blocks are pressed together and others drawn apart.
    std::vector<double> share;
    for (const auto node : top) share.push_back(scene.coordinate(node, 0) / side - 0.4);
    scene.drive(top, {0.0, 1.0}, load, share);
    scene.text("gluing", gluing);
    return scene;
}

void crossings(Study& study) {
    const struct {
        const char* subject;
        bool bonded;
        const char* gluing;
    } kinds[] = {{"cross-points", false, "orthonormal"},
                 {"cross-points-redundant", false, "redundant"},
                 {"cross-points-bonded", true, "orthonormal"}};
    for (const auto& kind : kinds) {
        if (!study.wanted(kind.subject)) continue;
        for (const double n : study.range({2, 3, 4, 6, 8}, 4)) {
            Trial t = trial_of(kind.subject, "blocks a side", n);
            // Some blocks are cut as well.
            t.subdomains = static_cast<int>(n * n) + 4;
            t.scene = [=] { return blocks(std::lround(n), kind.bonded, kind.gluing, false); };
            // Bonds around a crossing are redundant, so the forces among them are not unique.
            if (kind.bonded) t.compared = {true, false, false, true, true};
            t.defect_limit = closed_balance;
            study.run(t);
        }
    }
    if (!study.wanted("supports-twice")) return;
    for (const double n : study.range({1, 2, 3}, 2)) {
        Trial t = trial_of("supports-twice", "blocks a side", n);
        t.subdomains = static_cast<int>(n * n) + 4;
        t.scene = [=] { return blocks(std::lround(n), n == 1, "orthonormal", true); };
        t.direct = false;
        t.refused = "already";
        study.run(t);
    }
}

}  // namespace

void stability_contact(Study& study) {
    floating(study);
    corner(study);
    reversed(study);
    crossings(study);
}

}  // namespace harness
