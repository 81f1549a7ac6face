// SPDX-License-Identifier: BSD-3-Clause
// Energetic analyses under loads that rest, turn back and change direction, with laws that soften, and with other
// cells: the bounds hold, no candidate of the search has less energy than the kept state, and the history is
// consistent.
#include "energetic_scenes.hpp"
#include "flexure.hpp"
#include "small_analysis.hpp"

namespace {

using cases::Beam;
using reference::Law;
using reference::Scene;
using reference::Solver;

constexpr double eta = 1e-3;

struct Checked {
    double worst_margin = 0.0, worst_lower = 0.0, worst_upper = 0.0, worst_gap = 0.0;
    int violated = 0;
};

// Runs to the times; checks every step against its bounds and its search, and finally all kept steps as one history.
Checked walk(Solver& solver, const std::vector<double>& times) {
    const Scene& scene = solver.scene();
    const bool own = solver.value("step") == 0.0;
    double largest = 0.0;  // of all energies so far: a load that returns to zero has no scale of its own
    Checked c;
    for (const double time : times) {
        const std::int32_t status = solver.advance(time);
        scene.require(status < 0 || status == DELAM_LIMIT ? status : 0, "delam_solver_advance");
        largest = std::max(largest, std::max(cases::scale(solver), solver.value("dissipated")));
        if (largest > 0.0) {
            c.worst_margin = std::max(c.worst_margin, -solver.value("search_margin") / largest);
            c.worst_gap = std::max(c.worst_gap, solver.value("search_gap") / largest);
        }
        cases::expect(std::isfinite(cases::total(solver)) && std::isfinite(solver.value("search_gap")), "finite");
        solver.commit();
    }
    if (!own) return c;
    std::vector<double> before;
    double energy = 0.0, dissipated = 0.0;
    for (int k = 0; k <= static_cast<int>(times.size()); ++k) {
        REQUIRE(scene, delam_solver_look, solver.get(), k);
        const auto adhesion = solver.field("adhesion");
        const std::string where = "step " + std::to_string(k) + ": ";
        for (std::size_t p = 0; p < before.size(); ++p)
            cases::expect(adhesion[p] <= before[p], where + "adhesion grows");
        if (k > 0) {
            cases::expect_near(cases::stored(solver) - energy + solver.value("dissipated") - dissipated,
                               solver.value("increment"), 1e-10, largest, where + "increment");
            const double below = (solver.value("lower") - solver.value("increment_lower")) / largest;
            const double above = (solver.value("increment") - solver.value("upper")) / largest;
            c.violated += below > eta || above > eta ? 1 : 0;
            c.worst_lower = std::max(c.worst_lower, below);
            c.worst_upper = std::max(c.worst_upper, above);
            cases::expect(solver.value("dissipated") >= dissipated - 1e-12 * largest, where + "dissipation shrinks");
        }
        before = adhesion;
        energy = cases::stored(solver);
        dissipated = solver.value("dissipated");
    }
    REQUIRE(scene, delam_solver_look, solver.get(), -1);
    return c;
}

std::vector<double> times(int steps, double end = 1.0) {
    std::vector<double> t;
    for (int k = 1; k <= steps; ++k) t.push_back(end * k / steps);
    return t;
}
void expect_sound(const Checked& c, const std::string& what, int violated = 0) {
    std::printf("%s: margin %.2g, below %.2g, above %.2g, gap %.2g, violated %d\n", what.c_str(), -c.worst_margin,
                c.worst_lower, c.worst_upper, c.worst_gap, c.violated);
    cases::expect_below(c.worst_margin, 1e-9, what + ": energy above the search's candidates");
    cases::expect_below(c.violated, violated, what + ": steps beyond their bounds");
}

LOOP_TEST(brittle_flexure_misses_no_bound, 0, 2) {
    const int steps = loop == 0 ? 20 : 40;
    reference::FlexureScene f = reference::make_flexure(reference::find_flexure("enf-brittle"));
    f.scene.text("solution", "energetic");
    Solver solver(f.scene, 0.0);
    expect_sound(walk(solver, times(steps, 2.0)), "brittle ENF, " + std::to_string(steps) + " steps");
    cases::expect(solver.value("dissipated") > 0.0, "it breaks");
}

// ---- histories ----------------------------------------------------------------------------------------------------

// A beam whose load follows a table, and with `push` a second one at the right end of the notch.
Scene loaded(const std::vector<double>& at, const std::vector<double>& values, bool push = false) {
    Beam b;
    b.press = 0.0;
    Scene scene = cases::make_beam(b);
    const double top = 2.0 * cases::beam_layer;
    const auto press = scene.pattern("load", at, values);
    const auto quarter = scene.find(1, {0.075, top}, {0.075, top});
    scene.drive(quarter, {0.0, -1.0}, press, std::vector<double>(quarter.size(), 1.0));
    if (push) {
        const auto tip = scene.find(1, {0.0, top}, {0.0, top});
        scene.drive(tip, {0.0, 1.0}, scene.pattern("lift", {0.0, 0.5, 1.0}, {0.0, 0.0, 1e-3}),
                    std::vector<double>(tip.size(), 1.0));
    }
    return scene;
}

TEST(rest_reversal_and_reloading) {
    const double w = 4e-3;
    Scene scene = loaded({0.0, 0.1, 0.4, 0.6, 0.7, 0.8, 1.0}, {0.0, 0.0, 0.7 * w, -0.5 * w, 0.0, 0.0, 1.2 * w});
    cases::set_energetic(scene, 1e-2);
    Solver solver(scene, 0.0);
    Checked c = walk(solver, times(40));
    expect_sound(c, "reversed");
    cases::expect(solver.value("dissipated") > 0.0, "it breaks");
    // The decreasing load and the rest have added nothing.
    double at_top = -1.0, at_rest = -1.0;
    for (int k = 0; k <= 40; ++k) {
        REQUIRE(scene, delam_solver_look, solver.get(), k);
        if (k <= 4) cases::expect(cases::total(solver) == 0.0, "nothing happens without a load");
        if (k == 16) at_top = solver.value("dissipated");
        if (k == 20) at_rest = solver.value("dissipated");
    }
    cases::expect(at_top == at_rest, "unloading costs nothing");
}

// Two loads that are not proportional; saved during the analysis, the rest is the same to the bit.
TEST(turning_load_and_snapshot) {
    Scene scene = loaded({0.0, 1.0}, {0.0, 1.5e-3}, true), again = loaded({0.0, 1.0}, {0.0, 1.5e-3}, true);
    for (Scene* s : {&scene, &again}) cases::set_energetic(*s, 1e-2);
    Solver whole(scene, 0.0), resumed(again, 0.0);
    const auto all = times(20);
    expect_sound(walk(whole, {all.begin(), all.begin() + 13}), "turning load");
    again.require(resumed.load(whole.save()), "delam_solver_load");
    for (std::size_t k = 13; k < all.size(); ++k) {
        walk(whole, {all[k]});
        walk(resumed, {all[k]});
        cases::expect_same(resumed, cases::read_bits(resumed), cases::read_bits(whole),
                           "step " + std::to_string(k + 1));
    }
    cases::expect(whole.value("dissipated") > 0.0, "it breaks");
}

// Mirror-symmetric fronts: their candidates have equal energies except for rounding, so a continued analysis must
// choose alike.
LOOP_TEST(equal_fronts_and_snapshot, 0, 2) {
    Beam b;
    if (loop == 1) b.h = 3e-3;
    b.right = b.left;
    Scene scene = cases::make_beam(b);
    cases::set_energetic(scene, 1e-2);
    if (loop == 1) {
        scene.text("reduction", "feti");
        scene.number("subdomains", 4);
    }
    Solver whole(scene, 0.0);
    const auto all = times(12);
    for (std::size_t k = 0; k < all.size(); ++k) {
        Solver resumed(scene, 0.0);
        scene.require(resumed.load(whole.save()), "delam_solver_load");
        // A further step, rolled back, leaves nothing behind.
        whole.step(1.5 * all[k] + 0.2);
        whole.rollback();
        walk(whole, {all[k]});
        walk(resumed, {all[k]});
        cases::expect_same(resumed, cases::read_bits(resumed), cases::read_bits(whole),
                           "step " + std::to_string(k + 1));
    }
    cases::expect(whole.value("dissipated") > 0.0, "it breaks");
}

// ---- laws ---------------------------------------------------------------------------------------------------------

struct Softening {
    const char* kind;
    double plateau, gradient, k;
};
constexpr Softening softenings[] = {{"piecewise-linear", 0.0, 0.0, 1e12}, {"exponential", 0.0, 0.0, 1e12},
                                    {"trapezoidal", 0.5, 0.0, 1e12},      {"griffith", 0.0, 0.0, 1e13},
                                    {"exponential", 0.0, 0.0, 125e9},     {"piecewise-linear", 0.0, 1e-3, 1e12}};

LOOP_TEST(laws_that_soften, 0, 6) {
    const Softening& s = softenings[loop];
    Beam b;
    b.press = 6e-3;
    Scene scene = cases::make_beam(b);
    delam_law* raw = nullptr;
    REQUIRE(scene, delam_law_create, scene.context(), s.kind, &raw);
    const Law law(raw);
    const auto set = [&](const char* key, double value) { scene.require(delam_law_set(raw, key, value), key); };
    set("normal_stiffness", s.k);
    set("tangential_stiffness", s.k);
    if (std::string(s.kind) != "griffith") {
        set("normal_onset", 40.0);
        set("tangential_onset", 60.0);
    }
    set("normal_toughness", 100.0);
    set("tangential_toughness", 150.0);
    if (s.plateau > 0.0) set("plateau", s.plateau);
    if (s.gradient > 0.0) set("gradient", s.gradient);
    REQUIRE(scene, delam_problem_set_law, scene.problem(), 0, raw);
    scene.text("solution", "energetic");
    Solver solver(scene, 0.0);
    const Checked c = walk(solver, times(20));
    expect_sound(c, std::string(s.kind) + (s.gradient > 0.0 ? " with gradient" : ""));
    cases::expect(solver.value("dissipated") > 0.0, "it breaks");
}

// Cells with nodes between the corners, and simplices.
LOOP_TEST(other_cells, 0, 4) {
    const std::int32_t type[] = {DELAM_QUAD8, DELAM_TRI6, DELAM_HEX20, DELAM_TET10};
    const bool plane = loop < 2;
    const double length = 0.06, width = 0.004, layer = 3e-3;
    Scene scene = plane ? Scene(2, {length}, {20}, {layer, layer}, {1, 1}, type[loop])
                        : Scene(3, {length, width}, {15, 1}, {layer, layer}, {1, 1}, type[loop]);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, 75e9, 0.3);
    scene.law(0, cases::griffith_like(1e13));
    cases::notch(scene, 0, -1.0, 0.0175);
    const auto line = [&](int body, double x, double z) {
        return plane ? scene.find(body, {x, z}, {x, z}) : scene.find(body, {x, 0.0, z}, {x, width, z});
    };
    const std::vector<double> up = plane ? std::vector<double>{0.0, 1.0} : std::vector<double>{0.0, 0.0, 1.0};
    std::vector<double> along(up.size(), 0.0), down = up;
    along[0] = 1.0;
    down.back() = -1.0;
    for (const double x : {0.0, length}) scene.hold(line(0, x, 0.0), up);
    scene.hold(line(0, length, 0.0), along);
    if (!plane) scene.hold(scene.find(-1, {0.0, 0.0, 0.0}, {length, 0.0, 2 * layer}), {0.0, 1.0, 0.0});
    const auto middle = line(1, 0.5 * length, 2 * layer);
    cases::expect(!middle.empty(), "nodes at mid-span");
    scene.drive(middle, down, scene.pattern("press", {0.0, 1.0}, {0.0, 1e-3}), std::vector<double>(middle.size(), 1.0));
    scene.text("solution", "energetic");
    Solver solver(scene, 0.0);
    expect_sound(walk(solver, times(10)), "cells " + std::to_string(type[loop]));
    cases::expect(solver.value("dissipated") > 0.0, "it breaks");
}

// The first jump of an analysis in so many steps.
cases::Jump first_jump(int steps) {
    Beam b;
    b.right = 0.0;
    Scene scene = cases::make_beam(b);
    cases::set_energetic(scene);
    Solver solver(scene, 0.0);
    for (int k = 1; k <= steps; ++k) {
        solver.step(static_cast<double>(k) / steps);
        solver.commit();
    }
    const auto all = cases::jumps(solver);
    cases::expect(!all.empty(), "the crack jumps in " + std::to_string(steps) + " steps");
    const cases::Jump& jump = all.front();
    std::printf("%d steps: %zu jumps, the first at time %g over %g m, %g J/m released\n", steps, all.size(), jump.time,
                jump.debonded, jump.released);
    cases::expect(jump.released >= 0.0 && jump.dissipated > 0.0, "energies of the jump");
    cases::expect(jump.before <= jump.time && jump.time <= static_cast<double>(jump.step) / steps, "instant");
    return jump;
}

// The load of a jump is that at which the energies of two states cross, however many steps lead over it: of a crack
// that runs through a bent beam.
TEST(jump_of_coarse_steps) {
    const cases::Jump fine = first_jump(64);
    for (const int steps : {16, 5}) {
        const cases::Jump coarse = first_jump(steps);
        cases::expect_near(coarse.time, fine.time, 0.03, fine.time, "instant of the jump");
        cases::expect(coarse.debonded > 0.75 * fine.debonded, "length of the jump");
    }
}

}  // namespace
