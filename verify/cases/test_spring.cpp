// SPDX-License-Identifier: BSD-3-Clause
// An elastic block in series with the interface under uniform tension: the closed forms of a spring K and a bilinear
// law. Stiff springs (K above the softening slope) follow one continuous solution; soft ones jump at the local load and
// not before.
#include "api.hpp"
#include "support.hpp"

namespace {

using reference::Scene;
using reference::Solver;

constexpr double k = 125e9;
constexpr double onset = 100.0;
constexpr double toughness = 250.0;
const double peak = std::sqrt(2.0 * k * onset);
const double d0 = std::sqrt(2.0 * onset / k);
const double dc = d0 * toughness / onset;
const double slope = peak * peak / (2.0 * (toughness - onset));

// Spring constant K per unit area, shared equally by both blocks; a slim bar without lateral contraction, so that all
// pairs open alike.
Scene bar(double spring, const std::vector<double>& times, const std::vector<double>& ends, int dimension) {
    const double height = 1.0;
    const double width = 0.05;
    const bool plane = dimension == 2;
    Scene scene(dimension, plane ? std::vector<double>{width} : std::vector<double>{width, width},
                plane ? std::vector<std::int64_t>{1} : std::vector<std::int64_t>{1, 1}, {height, height}, {1, 1},
                plane ? DELAM_QUAD4 : DELAM_HEX8);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, spring * 2.0 * height, 0.0);
    scene.law(0, {k, k, onset, onset, toughness, toughness});
    const auto corner = std::vector<double>(static_cast<std::size_t>(dimension), 3.0);
    const auto all = scene.find(-1, std::vector<double>(corner.size(), 0.0), corner);
    std::vector<double> axial(corner.size(), 0.0);
    for (int i = 0; i + 1 < dimension; ++i) {
        std::vector<double> lateral(corner.size(), 0.0);
        lateral[static_cast<std::size_t>(i)] = 1.0;
        scene.hold(all, lateral);
    }
    axial.back() = 1.0;
    auto flat = corner;
    flat.back() = 0.0;
    scene.hold(scene.find(0, std::vector<double>(corner.size(), 0.0), flat), axial);
    auto low = std::vector<double>(corner.size(), 0.0);
    low.back() = 2.0 * height;
    const auto end = scene.find(1, low, corner);
    const auto load = scene.pattern("pull", times, ends);
    scene.drive(end, axial, load, std::vector<double>(end.size(), 1.0));
    scene.number("damage_tolerance", 1e-12);
    return scene;
}

struct Answer {
    double jump, traction;
};

// Series of K and the law on its loading branch, for K > slope.
Answer closed_form(double spring, double w) {
    const double start = peak * (1.0 / spring + 1.0 / k);
    if (w <= start) return {w / (1.0 + k / spring), w / (1.0 / spring + 1.0 / k)};
    if (w >= dc) return {w, 0.0};
    const double u = (w - slope * dc / spring) / (1.0 - slope / spring);
    return {u, slope * (dc - u)};
}

LOOP_TEST(stiff_spring_is_continuous, 0, 4) {
    const int dimension = loop < 3 ? 2 : 3;
    const double spring = slope * (loop == 0 ? 1.5 : loop == 1 ? 3.0 : 10.0);
    const int steps = 60;
    const double end = 1.1 * dc;
    const Scene scene = bar(spring, {0.0, 1.0}, {0.0, end}, dimension);
    Solver solver(scene, 0.0);
    for (int i = 1; i <= steps; ++i) {
        const double w = end * i / steps;
        solver.step(static_cast<double>(i) / steps);
        solver.commit();
        const Answer exact = closed_form(spring, w);
        const auto jump = solver.field("jump");
        const auto traction = solver.field("traction");
        const std::string where = "K/ks " + std::to_string(spring / slope) + ", step " + std::to_string(i) + ": ";
        for (std::size_t p = 0; p < jump.size(); p += static_cast<std::size_t>(dimension)) {
            cases::expect_near(jump[p], exact.jump, 1e-6, dc, where + "jump");
            cases::expect_near(traction[p], exact.traction, 1e-6, peak, where + "traction");
        }
    }
}

LOOP_TEST(soft_spring_jumps_at_the_local_load, 0, 2) {
    const double spring = slope * (loop == 0 ? 0.5 : 0.1);
    const double local = peak * (1.0 / spring + 1.0 / k);
    const Scene scene = bar(spring, {0.0, 1.0, 2.0}, {0.0, 0.999 * local, 1.001 * local}, 2);
    Solver solver(scene, 0.0);
    solver.step(1.0);
    solver.commit();
    for (const double z : solver.field("adhesion")) cases::expect(z == 1.0, "damage before the local load");
    solver.step(2.0);
    solver.commit();
    for (const double z : solver.field("adhesion")) cases::expect(z == 0.0, "no jump at 1.001 of the local load");
    cases::expect_near(solver.value("reaction:pull"), 0.0, 1e-10, peak, "nothing pulls after the jump");
    cases::expect_near(solver.value("dissipated"), toughness * 0.05, 1e-12, toughness * 0.05, "the toughness is spent");
}

// In one giant step a stiff spring still ends on its branch: the solution is unique.
TEST(stiff_spring_in_one_step) {
    const double spring = 3.0 * slope;
    const double w = 0.8 * dc;
    const Scene scene = bar(spring, {0.0, 1.0}, {0.0, w}, 2);
    Solver solver(scene, 0.0);
    solver.step(1.0);
    const auto jump = solver.field("jump");
    for (std::size_t p = 0; p < jump.size(); p += 2)
        cases::expect_near(jump[p], closed_form(spring, w).jump, 1e-6, dc, "jump");
}

}  // namespace
