// SPDX-License-Identifier: BSD-3-Clause
// Faces that are apart at the start. A gap of constant size only delays contact: the scene is then the one without gap
// whose drive begins later, in all that it says of forces and energies. Gaps of any size satisfy the conditions of
// contact, their conjugate force is the derivative of the energy, and all realisations give the same result.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "api.hpp"
#include "support.hpp"

namespace {

using reference::Scene;
using reference::Solver;

constexpr double young = 1e9, poisson = 0.3, height = 0.5;

std::vector<double> axis(int d, int k) {
    std::vector<double> e(static_cast<std::size_t>(d), 0.0);
    e[static_cast<std::size_t>(k)] = 1.0;
    return e;
}

std::vector<std::int64_t> at_height(const Scene& scene, std::int32_t body, double z) {
    std::vector<double> lower(static_cast<std::size_t>(scene.dimension()), -1.0), upper(lower.size(), 3.0);
    lower.back() = upper.back() = z;
    return scene.find(body, lower, upper);
}

// Blocks of 2 (x 1) x 0.5 upon each other in contact, the lowest face held, the highest one driven down by `push` at
// time 1; the blocks between float.
Scene stack(int d, int blocks, const char* reduction, double push) {
    Scene scene(d, d == 2 ? std::vector<double>{2.0} : std::vector<double>{2.0, 1.0},
                d == 2 ? std::vector<std::int64_t>{8} : std::vector<std::int64_t>{4, 2},
                std::vector<double>(static_cast<std::size_t>(blocks), height),
                std::vector<std::int64_t>(static_cast<std::size_t>(blocks), 2), d == 2 ? DELAM_QUAD4 : DELAM_HEX8);
    for (int i = 0; i + 1 < blocks; ++i) scene.interface(i, i + 1);
    scene.begin();
    scene.elastic(-1, young, poisson);
    for (int i = 0; i + 1 < blocks; ++i) scene.contact(i);
    const auto load = scene.pattern("push", {0.0, 1.0}, {0.0, push});
    const auto bottom = at_height(scene, 0, 0.0), top = at_height(scene, blocks - 1, blocks * height);
    for (int k = 0; k < d; ++k) scene.hold(bottom, axis(d, k));
    for (int k = 0; k + 1 < d; ++k) scene.hold(top, axis(d, k));
    scene.drive(top, axis(d, d - 1), load, std::vector<double>(top.size(), -1.0));
    scene.text("reduction", reduction);
    return scene;
}

// Gives interface i the gap base + slope x, as a pattern of its own.
void set_gap(Scene& scene, std::int64_t i, double base, double slope, const std::vector<double>& history) {
    const std::string name = "gap" + std::to_string(i);
    const auto pattern = scene.pattern(name.c_str(), {0.0, 1.0}, history);
    std::vector<double> gaps;
    for (const std::int64_t node : scene.pairs(i).node_b) gaps.push_back(base + slope * scene.coordinate(node, 0));
    REQUIRE(scene, delam_problem_set_gaps, scene.problem(), i, pattern, gaps.data(), 0.0);
}

struct Variant {
    int d;
    const char* reduction;
    double tolerance;
};
Variant variant(int loop) {
    const auto reduction = std::array{"condensed", "iterated", "feti"}[static_cast<std::size_t>(loop) % 3];
    return {loop / 3 == 0 ? 2 : 3, reduction, loop % 3 == 0 ? 1e-10 : 1e-8};
}

void expect_same(const Solver& solver, const Solver& other, double tolerance, const std::string& where) {
    const double energy = other.value("stored_bulk");
    cases::expect_near(solver.value("stored_bulk"), energy, tolerance, energy, where + ": stored energy");
    const double reaction = other.value("reaction:push");
    cases::expect_near(solver.value("reaction:push"), reaction, tolerance, std::abs(reaction), where + ": reaction");
    const auto stress = solver.field("stress"), expected = other.field("stress");
    double size = 0.0;
    for (const double s : expected) size = std::max(size, std::abs(s));
    for (std::size_t i = 0; i < stress.size(); ++i)
        cases::expect_near(stress[i], expected[i], tolerance, size, where + ": stress");
}

LOOP_TEST(later_contact, 0, 6) {
    const auto [d, reduction, tolerance] = variant(loop);
    const std::string where = std::to_string(d) + "D, " + reduction;
    for (const int blocks : {2, 3}) {
        const double gap = 2e-3 / (blocks - 1), push = 3e-3;
        Scene apart = stack(d, blocks, reduction, push);
        for (int i = 0; i + 1 < blocks; ++i) set_gap(apart, i, gap, 0.0, {1.0, 1.0});
        Solver solver(apart, 0.0);
        cases::expect_near(solver.value("stored_bulk"), 0.0, 1e-12, young * push * push, where + ": energy at rest");
        cases::expect_near(solver.field("jump").front(), gap, 1e-12, gap, where + ": distance of the faces at rest");
        solver.step(0.6);
        solver.commit();
        cases::expect_near(solver.value("reaction:push"), 0.0, 1e-9, young * push, where + ": reaction before contact");
        cases::expect_near(solver.value("contact_pairs"), 0.0, 0.0, 1.0, where + ": nothing presses yet");
        for (const double t : {2.0 / 3.0, 1.0}) {
            solver.step(t);
            solver.commit();
        }
        const Scene touching = stack(d, blocks, reduction, push - gap * (blocks - 1));
        Solver other(touching, 0.0);
        other.step(1.0);
        expect_same(solver, other, tolerance, where + ", " + std::to_string(blocks) + " blocks");
        cases::expect_near(solver.value("work"), solver.value("stored_bulk"), 1e-9, solver.value("stored_bulk"),
                           where + ": work is stored");
    }
}

// A wedge of a gap closes from one side.
LOOP_TEST(wedge, 0, 6) {
    const auto [d, reduction, tolerance] = variant(loop);
    const std::string where = std::to_string(d) + "D, " + reduction;
    constexpr double base = 1e-3, slope = 1.5e-3, push = 2.5e-3, part = 1e-4;
    std::array<double, 2> energy{};
    for (const int side : {-1, 1}) {
        Scene scene = stack(d, 2, reduction, push);
        set_gap(scene, 0, base * (1.0 + side * part), slope * (1.0 + side * part), {1.0, 1.0});
        Solver solver(scene, 0.0);
        solver.equilibrate(1.0, {});
        energy[side < 0 ? 0 : 1] = solver.value("stored_bulk");
    }
    Scene scene = stack(d, 2, reduction, push);
    set_gap(scene, 0, base, slope, {1.0, 1.0});
    Solver solver(scene, 0.0);
    solver.equilibrate(1.0, {});
    const double force = solver.value("reaction:gap0");
    cases::expect(force < 0.0, where + ": a larger gap takes pressure away");
    cases::expect_near(force, (energy[1] - energy[0]) / (2.0 * part), 1e-6, std::abs(force), where + ": dE/dgap");
    const auto jump = solver.field("jump"), traction = solver.field("traction");
    const auto rows = static_cast<std::size_t>(d);
    double most = 0.0;
    std::size_t open = 0, closed = 0;
    for (std::size_t r = 0; r < jump.size(); r += rows) most = std::max(most, std::abs(traction[r]));
    for (std::size_t r = 0; r < jump.size(); r += rows) {
        cases::expect(jump[r] >= -1e-10 * push, where + ": no penetration");
        cases::expect(traction[r] <= 1e-10 * most, where + ": no pull");
        cases::expect(std::abs(jump[r] * traction[r]) <= 1e-9 * push * most, where + ": complementarity");
        ++(jump[r] > 1e-9 * push ? open : closed);
    }
    cases::expect(open > 0 && closed > 0, where + ": contact on one side, a gap on the other");
    const auto node_b = scene.pairs(0).node_b;
    const auto u = solver.field("displacement");
    const auto node_a = scene.pairs(0).node_a;
    for (std::size_t p = 0; p < node_b.size(); ++p) {
        const auto z = [&u, last = rows - 1, rows](std::int64_t node) {
            return u[static_cast<std::size_t>(node) * rows + last];
        };
        const double left = base + slope * scene.coordinate(node_b[p], 0) + z(node_b[p]) - z(node_a[p]);
        cases::expect_near(jump[p * rows], left, 1e-9, push, where + ": the jump is the distance that is left");
    }
    if (std::string(reduction) == "condensed") return;
    Scene same = stack(d, 2, "condensed", push);
    set_gap(same, 0, base, slope, {1.0, 1.0});
    Solver other(same, 0.0);
    other.equilibrate(1.0, {});
    expect_same(solver, other, tolerance, where);
}

// A press fit, raised from 0, is what a drive does from outside.
LOOP_TEST(press_fit, 0, 6) {
    const auto [d, reduction, tolerance] = variant(loop);
    const std::string where = std::to_string(d) + "D, " + reduction;
    constexpr double interference = 1e-3;
    Scene scene = stack(d, 3, reduction, 0.0);
    set_gap(scene, 1, -interference, 0.0, {0.0, 1.0});
    Solver solver(scene, 0.0);
    for (const double t : {0.5, 1.0}) {
        solver.step(t);
        solver.commit();
    }
    const Scene pushed = stack(d, 3, reduction, interference);
    Solver other(pushed, 0.0);
    for (const double t : {0.5, 1.0}) {
        other.step(t);
        other.commit();
    }
    expect_same(solver, other, tolerance, where);
    const double work = interference * other.value("reaction:push");
    cases::expect_near(solver.value("reaction:gap1"), work, tolerance, work, where + ": dE/dfactor of the press fit");
    cases::expect_near(solver.value("work"), solver.value("stored_bulk"), 1e-9, solver.value("stored_bulk"),
                       where + ": work of the press fit");
}

}  // namespace
