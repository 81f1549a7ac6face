// SPDX-License-Identifier: BSD-3-Clause
// The energy that a front dissipates and releases, and the load that it needs, do not depend on how they are computed:
// stiff interfaces with the default tolerance; mixed mode in parts by every method; the ledger of coarse and fine
// steps.
#include <algorithm>
#include <array>
#include <vector>

#include "condensed_scenes.hpp"
#include "flexure.hpp"
#include "support.hpp"

namespace {

using reference::LawData;
using reference::Scene;
using reference::Solver;

// ---- stiff interfaces ----------------------------------------------------------------------------------------------

// A double cantilever in the plane, or three cells wide. Strength 20 MPa, Gc = 200 J/m2: with k = 1e18 N/m3 a pair
// that softens has an adhesion below 1e-6.
Scene cantilever(int d, double stiffness, const char* reduction, double tolerance) {
    constexpr double length = 0.03, width = 0.006, arm = 0.002, notch = 0.01, strength = 20e6;
    Scene scene(d, d == 2 ? std::vector<double>{length} : std::vector<double>{length, width},
                d == 2 ? std::vector<std::int64_t>{30} : std::vector<std::int64_t>{15, 3}, {arm, arm}, {1, 1},
                d == 2 ? DELAM_QUAD4 : DELAM_HEX8);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, 70e9, 0.3);
    scene.require(delam_problem_set_formulation(scene.problem(), -1, "incompatible"), "formulation");
    const double onset = 0.5 * strength * strength / stiffness;
    scene.law(0, {stiffness, stiffness, onset, onset, 200.0, 200.0, 1.0});
    const auto pairs = scene.pairs(0);
    std::vector<std::int64_t> open;
    for (std::size_t p = 0; p < pairs.count(); ++p)
        if (scene.coordinate(pairs.node_a[p], 0) < notch - 1e-6) open.push_back(static_cast<std::int64_t>(p));
    scene.adhesion(0, open, std::vector<double>(open.size(), 0.0));
    const auto end = cases::nodes_where(scene, -1, [](const double* x) { return x[0] > length - 1e-6; });
    for (int k = 0; k < d; ++k) scene.hold(end, cases::unit(d, k));
    const auto load = scene.pattern("open", {0.0, 1.0}, {0.0, 1.6e-4});
    for (const int body : {0, 1}) {
        const auto tip = cases::nodes_where(scene, body, [&](const double* x) {
            return x[0] < 1e-6 && (body == 0 ? x[d - 1] < 1e-6 : x[d - 1] > 2 * arm - 1e-6);
        });
        scene.drive(tip, cases::unit(d, d - 1), load, std::vector<double>(tip.size(), body == 0 ? -1.0 : 1.0));
    }
    scene.text("reduction", reduction);
    if (std::string(reduction) == "feti") scene.number("subdomains", 3);
    if (tolerance > 0.0) scene.number("damage_tolerance", tolerance);
    return scene;
}

struct Peak {
    double load = 0.0, dissipated = 0.0;
};
Peak peak_of(const Scene& scene) {
    Solver solver(scene, 0.0);
    Peak peak;
    for (int k = 1; k <= 10; ++k) {
        solver.step(0.1 * k);
        peak.load = std::max(peak.load, std::abs(solver.value("reaction:open")));
        solver.commit();
    }
    peak.dissipated = solver.value("dissipated");
    return peak;
}

// loop: dimension, then stiffness, then reduction.
LOOP_TEST(stiff_interfaces_stop_at_rest, 0, 12) {
    const int d = 2 + loop % 2;
    const double stiffness = loop / 2 % 2 == 0 ? 1e17 : 1e18;
    const char* reduction = std::array{"condensed", "feti", "iterated"}[static_cast<std::size_t>(loop) / 4];
    const Peak exact = peak_of(cantilever(d, stiffness, reduction, 1e-9)),
               usual = peak_of(cantilever(d, stiffness, reduction, 0.0));
    std::printf("%dD, k %g, %s: peak %.8g N, with the default tolerance %.8g; dissipated %.8g, %.8g J\n", d, stiffness,
                reduction, exact.load, usual.load, exact.dissipated, usual.dissipated);
    cases::expect(exact.dissipated > 0.0, "the front moves");
    cases::expect_near(usual.load, exact.load, 1e-4, exact.load, "peak");
    cases::expect_near(usual.dissipated, exact.dissipated, 1e-4, exact.dissipated, "dissipated");
    if (loop / 4 == 0) return;
    const Peak condensed = peak_of(cantilever(d, stiffness, "condensed", 1e-9));
    std::printf("beside the condensed operator: peak %.1e, dissipated %.1e\n", exact.load / condensed.load - 1.0,
                exact.dissipated / condensed.dissipated - 1.0);
    cases::expect_near(exact.load, condensed.load, 1e-10, condensed.load, "peak beside the condensed operator");
    cases::expect_near(exact.dissipated, condensed.dissipated, 1e-10, condensed.dissipated,
                       "dissipated beside the condensed operator");
}

// ---- mixed mode ----------------------------------------------------------------------------------------------------

// The mixed-mode flexure with a short notch, whose front jumps; sliding dissipates 3.65 times as much as opening.
reference::Flexure jumping(double h, double stiffness) {
    reference::Flexure data = reference::find_flexure("mmf-ductile");
    data.law = {stiffness, stiffness, 5.0, 18.25, 200.0, 730.0, 1.0};
    data.h = h;
    data.notch = stiffness > 5e12 ? 0.015 : 0.012;
    data.final_load = 4e-3;
    return data;
}

struct Analysis {
    std::vector<double> load, error, balance;  // balance: stored, dissipated and released less the work
    double dissipated, released, work, jumps;
    std::vector<double> adhesion;
    double before = 0.0, time = 0.0, carried = 0.0;  // of the last jump: its instants, and the load before it
    std::size_t step = 0;
};

Analysis analyse(const reference::Flexure& data, int steps, const char* reduction = "condensed",
                 const char* minimisation = "auto", double path_step = 0.1) {
    reference::FlexureScene f = reference::make_flexure(data);
    f.scene.text("reduction", reduction);
    f.scene.text("minimisation", minimisation);
    f.scene.number("path_step", path_step);
    f.scene.text("step_control", "fixed");  // so that each step is followed at its own load
    f.scene.number("damage_tolerance", 1e-7);
    if (std::string(reduction) == "feti") f.scene.number("subdomains", 3);
    Solver solver(f.scene, 0.0);
    Analysis m{};
    for (int k = 1; k <= steps; ++k) {
        solver.step(data.end_time * k / steps);
        solver.commit();
        m.released += solver.value("released");
        m.load.push_back(std::abs(solver.value("reaction:press")));
        m.error.push_back(solver.value("mixity_error"));
        m.balance.push_back(solver.value("stored_bulk") + solver.value("stored_interface") +
                            solver.value("dissipated") + m.released - solver.value("work"));
        cases::expect_near(m.balance.back(), solver.value("defect"), 1e-9, solver.value("work"), "defect");
    }
    m.dissipated = solver.value("dissipated");
    m.work = solver.value("work");
    m.adhesion = solver.field("adhesion");
    std::int64_t jumps = 0;
    REQUIRE(f.scene, delam_solver_jump_count, solver.get(), &jumps);
    m.jumps = static_cast<double>(jumps);
    if (jumps > 0) {
        std::int64_t step = 0;
        double carried = 0.0;
        REQUIRE(f.scene, delam_solver_jump, solver.get(), jumps - 1, &step, &m.before, &m.time, nullptr, nullptr,
                nullptr, nullptr, nullptr, nullptr, nullptr);
        REQUIRE(f.scene, delam_solver_jump_reactions, solver.get(), jumps - 1, 1, &carried, nullptr);
        m.step = static_cast<std::size_t>(step);
        m.carried = std::abs(carried);
        std::printf("jump of step %d at %.9g to %.9g, load before it %.7g\n", static_cast<int>(step), m.before, m.time,
                    m.carried);
    }
    std::printf(
        "MMF, h %g mm, %d steps, %s, %s, path_step %g: dissipated %.7g, released %.4g, balance %.1e J/m, jumps %g\n",
        1e3 * data.h, steps, reduction, minimisation, path_step, m.dissipated, m.released, m.balance.back(), m.jumps);
    return m;
}

TEST(one_path_by_all_methods) {
    const reference::Flexure data = jumping(1.5e-3, 1e12);
    constexpr int steps = 20;
    const Analysis own = analyse(data, steps, "condensed", "accelerated");
    const double largest = *std::max_element(own.load.begin(), own.load.end());
    cases::expect(own.load[5] < 0.75 * largest && own.load.back() > 0.75 * largest, "the load falls and rises again");
    const auto same = [&](const Analysis& other, double dissipated, const std::string& what) {
        cases::expect_near(other.dissipated, own.dissipated, dissipated, own.dissipated, what + ": dissipated");
        for (std::size_t k = 0; k < own.load.size(); ++k)
            cases::expect_near(other.load[k], own.load[k], 1e-4, largest,
                               what + ": load of step " + std::to_string(k + 1));
        for (std::size_t p = 0; p < own.adhesion.size(); ++p)
            cases::expect_near(other.adhesion[p], own.adhesion[p], 1e-4, 1.0, what + ": adhesion");
    };
    same(analyse(data, steps, "condensed", "alternate"), 1e-4, "alternate");
    same(analyse(data, steps, "feti", "accelerated"), 1e-4, "feti");
    same(analyse(data, steps, "iterated", "accelerated"), 1e-4, "iterated");
    same(analyse(data, steps, "condensed", "accelerated", 0.05), 2e-3, "parts half as long");
    if (!cases::whole()) return;
    same(analyse(data, steps, "feti", "alternate"), 1e-4, "feti, alternate");
    same(analyse(data, steps, "iterated", "alternate"), 1e-4, "iterated, alternate");
    same(analyse(data, steps, "condensed", "accelerated", 0.02), 3e-3, "parts a fifth as long");
}

// The work of the loads is stored, dissipated or released, and the jump is one, in coarse steps as in fine ones,
// wherever in a step it comes.
LOOP_TEST(ledger_of_a_jump, 0, 2) {
    const reference::Flexure data = jumping(loop == 0 ? 3e-3 : 1.5e-3, 1e13);
    double fine = 0.0, carried = 0.0, instant = 0.0;
    for (const int steps : {80, 20}) {
        const Analysis m = analyse(data, steps);
        const auto time_of = [&](std::size_t step) { return data.end_time * static_cast<double>(step) / steps; };
        cases::expect(m.before == m.time && m.time >= time_of(m.step - 1) && m.time <= time_of(m.step),
                      "one instant, within its step");
        const double largest = *std::max_element(m.load.begin(), m.load.begin() + static_cast<std::ptrdiff_t>(m.step));
        std::printf("largest load of the steps up to it %.7g\n", largest);
        cases::expect_below(largest, m.carried * (1.0 + 1e-3), "the load before the jump is what the beam carries");
        if (steps == 80) carried = m.carried, instant = m.time;
        // Steps four times as long: 3 % and 5 % on the coarse mesh, 0.1 % on the fine one.
        cases::expect_near(m.carried, carried, loop == 0 ? 5e-2 : 1e-2, carried, "load before the jump");
        cases::expect_near(m.time, instant, loop == 0 ? 8e-2 : 1e-2, instant, "instant of the jump");
        for (std::size_t k = 0; k < m.balance.size(); ++k)
            cases::expect_near(m.balance[k], 0.0, 1e-3, m.work, "ledger of step " + std::to_string(k + 1));
        cases::expect(m.jumps == 1.0, std::to_string(m.jumps) + " jumps of " + std::to_string(steps) + " steps");
        cases::expect(m.released > 0.05 * m.dissipated, "released");
        if (steps == 80) fine = m.released;
        cases::expect_near(m.released, fine, 0.25, fine, "released in coarse steps");
    }
}

// A double cantilever with a second notch before its crack (mm, N). The ligament between them snaps when its zones have
// met, with 4 mm of crack behind it: where the load is controlled at the end of the arm, that is a jump.
Scene with_ligament(std::int64_t cells) {
    constexpr double length = 60.0, arm = 1.5, stiffness = 1e5, strength = 20.0;
    Scene scene(2, {length}, {cells}, {arm, arm}, {2, 2}, DELAM_QUAD4);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, 70e3, 0.3);
    scene.require(delam_problem_set_formulation(scene.problem(), -1, "incompatible"), "formulation");
    const double onset = 0.5 * strength * strength / stiffness;
    scene.law(0, {stiffness, stiffness, onset, onset, 0.3, 0.3, 1.0});
    const auto pairs = scene.pairs(0);
    std::vector<std::int64_t> open;
    for (std::size_t p = 0; p < pairs.count(); ++p)
        if (const double x = scene.coordinate(pairs.node_a[p], 0);
            x < 15.0 - 1e-6 || (x > 20.0 + 1e-6 && x < 30.0 - 1e-6))
            open.push_back(static_cast<std::int64_t>(p));
    scene.adhesion(0, open, std::vector<double>(open.size(), 0.0));
    const auto end = cases::nodes_where(scene, -1, [](const double* x) { return x[0] > length - 1e-6; });
    for (int k = 0; k < 2; ++k) scene.hold(end, cases::unit(2, k));
    const auto load = scene.pattern("open", {0.0, 1.0}, {0.0, 1.5});
    for (const int body : {0, 1}) {
        const auto tip = cases::nodes_where(scene, body, [&](const double* x) {
            return x[0] < 1e-6 && (body == 0 ? x[1] < 1e-6 : x[1] > 2 * arm - 1e-6);
        });
        scene.drive(tip, cases::unit(2, 1), load, std::vector<double>(tip.size(), body == 0 ? -0.5 : 0.5));
    }
    return scene;
}

// The last ligament between two cracks is one jump, at one load and with one release, in coarse steps and in fine ones,
// whether ten pairs or twenty are left between them.
LOOP_TEST(a_ligament_snaps, 0, 2) {
    const Scene scene = with_ligament(loop == 0 ? 120 : 240);
    double fine = 0.0, instant = 0.0;
    for (const int steps : {50, 15, 5}) {
        Solver solver(scene, 0.0);
        double jumps = 0.0, open = 0.0, at = 0.0, released = 0.0;
        for (int k = 1; k <= steps; ++k) {
            solver.step(static_cast<double>(k) / steps);
            jumps += solver.value("jumps");
            open = std::max(open, std::abs(solver.value("defect")));
            solver.commit();
        }
        double before = 0.0, stored = 0.0, dissipated = 0.0, debonded = 0.0;
        std::int64_t step = 0, interface = 0, first = 0, last = 0;
        REQUIRE(scene, delam_solver_jump, solver.get(), 0, &step, &before, &at, &stored, &dissipated, &released,
                &debonded, &interface, &first, &last);
        std::printf("%d steps: at %.6g released %.6g, open %.3g of %.6g\n", steps, at, released, open,
                    solver.value("dissipated"));
        cases::expect(jumps == 1.0, std::to_string(jumps) + " jumps in " + std::to_string(steps) + " steps");
        if (steps == 50) fine = released, instant = at;
        cases::expect_near(at, instant, 5e-3, instant, "instant");
        cases::expect_near(released, fine, 2e-2, fine, "released");
        cases::expect_below(open, 1e-2 * solver.value("dissipated"), "left open");
    }
}

// Two bars (mm, N) that are pulled apart snap when the interface has its strength, 50 N/mm2 on 10 mm: the jump has this
// load, however long the steps are.
TEST(a_jump_comes_at_its_load) {
    constexpr double width = 10.0, height = 20.0, stiffness = 1e5, strength = 50.0, young = 70e3;
    Scene scene(2, {width}, {5}, {height, height}, {4, 4}, DELAM_QUAD4);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, young, 0.0);
    const double onset = 0.5 * strength * strength / stiffness;
    scene.law(0, {stiffness, stiffness, onset, onset, 0.5, 0.5, 1.0});
    const auto at = [&](double y) {
        return cases::nodes_where(scene, -1, [y](const double* x) { return std::abs(x[1] - y) < 1e-6; });
    };
    scene.hold(at(0.0), {0.0, 1.0});
    for (const double y : {0.0, 2.0 * height})
        scene.hold(
            cases::nodes_where(scene, -1, [y](const double* x) { return x[0] < 1e-6 && std::abs(x[1] - y) < 1e-6; }),
            {1.0, 0.0});
    const auto load = scene.pattern("pull", {0.0, 1.0}, {0.0, 0.06});
    scene.drive(at(2.0 * height), {0.0, 1.0}, load, std::vector<double>(6, 1.0));
    const double peak = strength * width, displacement = peak * (2.0 * height / young + 1.0 / stiffness) / width;
    for (const int steps : {2, 3, 7, 37}) {
        Solver solver(scene, 0.0);
        double jumps = 0.0;
        for (int k = 1; k <= steps && jumps == 0.0; ++k) {
            solver.step(static_cast<double>(k) / steps);
            jumps += solver.value("jumps");
            solver.commit();
        }
        double before = 0.0, at_jump = 0.0, stored = 0.0, dissipated = 0.0, released = 0.0, debonded = 0.0,
               load_before[1], load_after[1];
        std::int64_t step = 0, interface = 0, first = 0, last = 0;
        REQUIRE(scene, delam_solver_jump, solver.get(), 0, &step, &before, &at_jump, &stored, &dissipated, &released,
                &debonded, &interface, &first, &last);
        REQUIRE(scene, delam_solver_jump_reactions, solver.get(), 0, 1, load_before, load_after);
        std::printf("%d steps: at %.6g of %.6g, load %.6g of %.6g, released %.6g\n", steps, 0.06 * at_jump,
                    displacement, load_before[0], peak, released);
        cases::expect_near(0.06 * at_jump, displacement, 4e-3, displacement, "displacement");
        cases::expect_near(load_before[0], peak, 4e-3, peak, "load");
        cases::expect_near(released, 0.5 * peak * displacement - 0.5 * width, 2e-2, released, "released");
    }
}

// A front with few pairs in its process zone follows path_step, too: each time that parts are half as long, the
// dissipated energy changes, and by less and less.
LOOP_TEST(few_pairs_follow_path_step, 0, 2) {
    const reference::Flexure data = jumping(loop == 0 ? 3e-3 : 1.5e-3, 1e13);
    std::vector<double> dissipated;
    for (const double path_step : {0.1, 0.05, 0.025, 0.0125})
        dissipated.push_back(analyse(data, 5, "condensed", "auto", path_step).dissipated);
    for (std::size_t k = 0; k + 1 < dissipated.size(); ++k)
        cases::expect(std::abs(dissipated[k + 1] - dissipated[k]) > 1e-5 * dissipated[k], "parts change the path");
    cases::expect_below(std::abs(dissipated[3] - dissipated[2]), 0.8 * std::abs(dissipated[1] - dissipated[0]),
                        "they change it less and less");
}

// Steps sixteen times as long: the same front, and what it dissipates as well as their own estimate says.
TEST(coarse_and_fine_steps) {
    const reference::Flexure data = jumping(1.5e-3, 1e12);
    const Analysis coarse = analyse(data, 20), fine = analyse(data, 320);
    const double estimate = *std::max_element(coarse.error.begin(), coarse.error.end());
    cases::expect_near(coarse.load.back(), fine.load.back(), 1e-4, fine.load.back(), "load in the end");
    cases::expect_near(coarse.dissipated, fine.dissipated, estimate, fine.dissipated, "dissipated");
    cases::expect_below(estimate, 0.05, "estimate of its error");
}

}  // namespace
