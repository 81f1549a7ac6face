// SPDX-License-Identifier: BSD-3-Clause
// Weak points of the energetic search: several fronts, several interfaces, intact ones, space, floating bodies and dead
// loads, limits, other operators, other units. Rivals are whole displacement solves (energetic_scenes.hpp).
#include "energetic_scenes.hpp"
#include "mmf.hpp"
#include "small_analysis.hpp"

namespace {

using cases::Beam;
using cases::Block;
using cases::Rivals;
using reference::Scene;
using reference::Solver;

// ---- several fronts -----------------------------------------------------------------------------------------------

// Squares of 3 mm here and below; of 1.5 mm, too, in the long tier: the number of pairs of fronts grows with 1/h^2.
LOOP_TEST(two_fronts_of_a_flexure, 0, 4) {
    const double h = loop < 2 ? 3e-3 : 1.5e-3;
    const bool symmetric = loop % 2 == 1;
    if (loop >= 2 && !cases::whole()) return;
    Beam b;
    b.h = h;
    if (symmetric) b.right = b.left;
    reference::Scene scene = cases::make_beam(b);
    const double middle = 0.5 * cases::beam_length;
    const Rivals rivals(scene, {cases::run(scene, 0, b.left - 0.25 * h, middle + 4 * h),
                                cases::run(scene, 0, middle - 4 * h, cases::beam_length - b.right + 0.25 * h, true)});
    cases::set_energetic(scene);
    const auto dissipated = cases::analyse_below(scene, rivals, 12);
    cases::expect(dissipated.front() == 0.0 && dissipated.back() > 0.0, "a front moves");
}

// Two equal patches under a soft block: breaking only one releases almost nothing.
TEST(only_the_joint_advance_pays) {
    Block b;
    b.cells = 13;
    b.end = 1.3 * cases::energetic_load(b) * std::sqrt(8.0 / 13.0);
    Scene scene = cases::make_block(b);
    const double h = b.width / 13.0;
    cases::notch(scene, 0, 3.5 * h, 9.5 * h);
    const Rivals rivals(scene, {cases::run(scene, 0, -h, 3.5 * h, true), cases::run(scene, 0, 9.5 * h, b.width + h)});
    cases::set_energetic(scene);
    const auto dissipated = cases::analyse_below(scene, rivals, 13);
    double all = 0.0;
    for (const std::size_t p : cases::run(scene, 0, -h, b.width + h))
        all += p <= 3 || p >= 10 ? cases::toughness * cases::all_weights(scene)[p] : 0.0;
    cases::expect_near(dissipated.back(), all, 1e-9, all, "both patches let go");
}

// ---- two interfaces in one stack ----------------------------------------------------------------------------------

LOOP_TEST(two_interfaces, 0, 4) {
    const double h = loop < 2 ? 3e-3 : 1.5e-3;
    const bool symmetric = loop % 2 == 1;
    if (loop >= 1 && !cases::whole()) return;
    Beam b;
    b.h = h;
    b.layers = 3;
    b.right = 0.0;
    b.left_above = symmetric ? b.left : 0.021;
    b.press = 6e-3;
    reference::Scene scene = cases::make_beam(b);
    const Rivals rivals(
        scene, {cases::run(scene, 0, b.left - 0.25 * h, 0.066), cases::run(scene, 1, b.left_above - 0.25 * h, 0.066)});
    cases::set_energetic(scene);
    const auto dissipated = cases::analyse_below(scene, rivals, 10);
    cases::expect(dissipated.back() > 0.0, "a front moves");
}

// ---- nucleation ---------------------------------------------------------------------------------------------------

// The whole intact interface separates at w = sqrt(2 Gc (1/K + 1/k)), however many pairs it has.
LOOP_TEST(intact_interface_lets_go_at_once, 0, 2) {
    Block b;
    b.cells = loop == 0 ? 12 : 80;
    b.end = 2.0 * cases::energetic_load(b);
    Scene scene = cases::make_block(b);
    cases::set_energetic(scene);
    Solver solver(scene, 0.0);
    double low = 0.0, high = 1.0;
    for (int i = 0; i < 8; ++i) {
        const double time = 0.5 * (low + high);
        solver.step(time);
        (solver.value("dissipated") > 0.0 ? high : low) = time;
        solver.rollback();
    }
    cases::expect_near(high * b.end, cases::energetic_load(b), 2.0 / 256.0, b.end, "load of the jump");
}

// A weak spot inside an intact beam: the crack begins there.
TEST(weak_spot) {
    Beam b;
    b.left = b.right = 0.0;
    b.press = 2e-3;
    Scene scene = cases::make_beam(b);
    const auto weak = cases::pairs_where(scene, 0, 0.0295, 0.0425);
    scene.adhesion(0, weak, std::vector<double>(weak.size(), 1e-2));
    Rivals::Run run;
    for (const auto p : weak) run.push_back(static_cast<std::size_t>(p));
    const Rivals rivals(scene, {run});
    cases::set_energetic(scene);
    const auto dissipated = cases::analyse_below(scene, rivals, 8);
    cases::expect(dissipated.back() > 0.0, "the weak spot breaks");
}

// ---- space --------------------------------------------------------------------------------------------------------

// Opened or bent; condensed, or by an iteration whose candidates have energies of few digits.
LOOP_TEST(straight_fronts_in_space, 0, 4) {
    const double length = 0.06, width = 0.008, layer = 2e-3;
    Scene scene(3, {length, width}, {30, 2}, {layer, layer}, {1, 1}, DELAM_HEX8);
    scene.interface(0, 1);
    scene.begin();
    scene.require(delam_problem_set_formulation(scene.problem(), -1, "incompatible"), "formulation");
    scene.elastic(-1, 75e9, 0.0);
    scene.law(0, cases::griffith_like(1e13));
    cases::notch(scene, 0, -1.0, 0.019);
    const bool opened = loop % 2 == 0;
    const auto face = [&](int body, double x, double z) { return scene.find(body, {x, 0.0, z}, {x, width, z}); };
    double x = 0.0;
    if (opened) {
        scene.hold(face(0, 0.0, 0.0), {0.0, 0.0, 1.0});
        scene.hold(scene.find(0, {length, 0.0, 0.0}, {length, width, layer}), {1.0, 0.0, 0.0});
        scene.hold(face(0, length, 0.0), {0.0, 0.0, 1.0});
    } else {
        scene.hold(face(0, 0.0, 0.0), {0.0, 0.0, 1.0});
        scene.hold(face(0, length, 0.0), {0.0, 0.0, 1.0});
        scene.hold(face(0, length, 0.0), {1.0, 0.0, 0.0});
        x = 0.5 * length;
    }
    scene.hold(scene.find(-1, {0.0, 0.0, 0.0}, {length, 0.0, 2 * layer}), {0.0, 1.0, 0.0});
    const auto driven = face(1, x, 2 * layer);
    scene.drive(driven, {0.0, 0.0, opened ? 1.0 : -1.0},
                scene.pattern("load", {0.0, 1.0}, {0.0, opened ? 1.2e-3 : 2.5e-3}),
                std::vector<double>(driven.size(), 1.0));
    // Rows of pairs across the width, from the notch on.
    const auto pairs = scene.pairs(0);
    Solver probe(scene, 0.0);
    std::vector<double> adhesion = probe.field("adhesion"), energy, spent, initial = adhesion;
    double cost = 0.0;
    for (double front = 0.019; front < length - 0.005; front += 0.002) {
        probe.equilibrate(1.0, adhesion);
        energy.push_back(cases::stored(probe));
        spent.push_back(cost);
        probe.rollback();
        for (std::size_t p = 0; p < pairs.count(); ++p)
            if (adhesion[p] > 0.0 && scene.coordinate(pairs.node_a[p], 0) < front + 0.002) {
                adhesion[p] = 0.0;
                cost += cases::toughness * pairs.weight[p];
            }
    }
    cases::set_energetic(scene);
    scene.text("reduction", loop < 2 ? "condensed" : "iterated");
    Solver solver(scene, 0.0);
    for (int k = 1; k <= 8; ++k) {
        const double t = k / 8.0;
        solver.step(t);
        double rival = INFINITY;
        // An analysis may be ahead of a scan without history: only fronts that dissipate at least what was spent.
        for (std::size_t f = 0; f < energy.size(); ++f)
            if (f > 0 || k == 1 || solver.value("dissipated") == 0.0)
                rival = std::min(rival, t * t * energy[f] + spent[f]);
        cases::expect_below((cases::total(solver) - rival) / cases::scale(solver), 2e-3,
                            "step " + std::to_string(k) + ": above straight fronts");
        cases::expect_below(-solver.value("search_margin") / cases::scale(solver), 1e-9, "margin");
        solver.commit();
    }
    cases::expect(solver.value("dissipated") > 0.0, "the front moves");
}

// ---- parts that separate ------------------------------------------------------------------------------------------

// A block that nothing holds sideways once it is off: breaking all pairs is a candidate, as it is where the block is
// held.
LOOP_TEST(floating_block_comes_off, 0, 2) {
    Block b;
    b.held = false;
    b.end = 1.5 * cases::energetic_load(b);
    Scene scene = cases::make_block(b);
    if (loop == 1) cases::notch(scene, 0, -1.0, 0.4 * b.width);
    const Rivals rivals(scene, {cases::run(scene, 0, loop == 1 ? 0.4 * b.width : -1.0, 1.0)});
    cases::set_energetic(scene);
    const auto dissipated = cases::analyse_below(scene, rivals, 6);
    cases::expect(dissipated.back() > 0.0, "the block comes off");
}

// Under a dead load there is no equilibrium without the interface: such candidates are skipped, and the library claims
// no bound for them.
TEST(dead_load) {
    Beam b;
    b.right = 0.0;
    Scene scene = cases::make_beam(b);
    const auto tip = scene.find(1, {0.0, 2 * cases::beam_layer}, {0.0, 2 * cases::beam_layer});
    const std::vector<double> force{0.0, 2e4};
    REQUIRE(scene, delam_problem_add_forces, scene.problem(), scene.pattern("hang", {0.0, 1.0}, {0.0, 1.0}), 1,
            tip.data(), force.data(), 0);
    cases::set_energetic(scene);
    Solver solver(scene, 0.0);
    double worst = 0.0;
    int k = 1;
    for (; k <= 12; ++k) {
        const std::int32_t status = solver.advance(k / 12.0);
        if (status == DELAM_LIMIT) break;
        scene.require(status, "delam_solver_advance");
        worst = std::max(worst, -solver.value("search_margin") / cases::scale(solver));
        cases::expect(std::isfinite(cases::total(solver)), "finite energies");
        solver.commit();
    }
    cases::expect(k > 2, "the first steps are in balance");
    cases::expect_below(worst, 1e-9, "energy above the search's candidates");
}

// ---- limits -------------------------------------------------------------------------------------------------------

LOOP_TEST(a_limited_search_says_so, 0, 4) {
    const int limit = loop == 0 ? 0 : loop == 1 ? 1 : loop == 2 ? 2 : 5;
    Beam b;
    Scene scene = cases::make_beam(b);
    cases::set_energetic(scene);
    scene.number("search_limit", limit);
    scene.text("backtracking", "off");
    Solver solver(scene, 0.0);
    solver.step(0.35);
    cases::expect_below(solver.value("search_candidates"), limit, "candidates beyond the limit");
    cases::expect(solver.value("search_gap") > 0.0, "fronts that were not compared may be lower");
    cases::expect_below(solver.value("damage_change"), 1e-5, "a critical point all the same");
    const double limited = cases::total(solver), gap = solver.value("search_gap");
    Scene whole = cases::make_beam(b);
    cases::set_energetic(whole);
    Solver best(whole, 0.0);
    best.step(0.35);
    cases::expect_below(limited - gap - cases::total(best), 1e-9 * cases::scale(best), "the gap holds the best state");
    cases::expect_below(best.value("search_gap") / cases::scale(best), 1e-8, "gap of the whole search");
}

// ---- other ways to the same states --------------------------------------------------------------------------------

std::vector<std::vector<double>> states(Scene& scene, int steps, std::vector<double>* energy = nullptr) {
    cases::set_energetic(scene);
    Solver solver(scene, 0.0);
    std::vector<std::vector<double>> all;
    for (int k = 1; k <= steps; ++k) {
        solver.step(static_cast<double>(k) / steps);
        solver.commit();
        all.push_back(solver.field("adhesion"));
        if (energy != nullptr) energy->push_back(cases::total(solver));
    }
    return all;
}

void expect_same_states(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b,
                        bool mirrored, const char* what) {
    for (std::size_t k = 0; k < a.size(); ++k)
        for (std::size_t p = 0; p < a[k].size(); ++p)
            cases::expect_near(b[k][mirrored ? b[k].size() - 1 - p : p], a[k][p], 1e-4, 1.0,
                               std::string(what) + ", step " + std::to_string(k + 1) + ", pair " + std::to_string(p));
}

LOOP_TEST(same_states_by_other_operators, 0, 2) {
    Beam b;
    b.h = 3e-3;
    Scene condensed = cases::make_beam(b), other = cases::make_beam(b);
    condensed.text("reduction", "condensed");
    const char* const reduction = loop == 0 ? "feti" : "iterated";
    other.text("reduction", reduction);
    if (loop == 0) other.number("subdomains", 4);
    expect_same_states(states(condensed, 6), states(other, 6), false, reduction);
}

TEST(same_energy_by_alternation) {
    Beam b;
    Scene fast = cases::make_beam(b), plain = cases::make_beam(b);
    plain.text("minimisation", "alternate");
    std::vector<double> a, c;
    states(fast, 6, &a);
    states(plain, 6, &c);
    for (std::size_t k = 0; k < a.size(); ++k)
        cases::expect_near(c[k], a[k], 1e-6, a[k], "energy of step " + std::to_string(k + 1));
}

LOOP_TEST(same_states_in_other_units_and_mirrored, 0, 3) {
    Beam b;
    b.left = 0.033;
    Scene scene = cases::make_beam(b);
    const auto a = states(scene, 6);
    Beam other = b;
    if (loop == 0)
        other.mirrored = true;
    else {
        other.units = 1024.0;
        other.force = loop == 1 ? 1.0 : 1.0 / 65536.0;
    }
    Scene again = cases::make_beam(other);
    expect_same_states(a, states(again, 6), other.mirrored, loop == 0 ? "mirrored" : "units");
}

}  // namespace
