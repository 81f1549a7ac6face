// SPDX-License-Identifier: BSD-3-Clause
// Accelerated against plain alternate minimisation. Where the incremental problem has one critical point the analyses
// agree; where it has many, each end state is shown to be one (watched_analysis.hpp) and the energies are printed.
#include <array>
#include <cstdio>
#include <functional>
#include <utility>

#include "condensed_scenes.hpp"
#include "enf.hpp"
#include "watched_analysis.hpp"

namespace {

using cases::LawData;
using cases::Scene;
using cases::Watch;
using cases::Watched;
using reference::Solver;

constexpr LawData ductile{125e9, 125e9, 100.0, 100.0, 250.0, 250.0};
constexpr LawData brittle{125e15, 125e15, 0.01, 0.01, 25.0, 25.0};

Scene enf(double h, const LawData& law, const char* reduction, const char* minimisation, double delta) {
    cases::Enf e;
    e.h = h;
    e.law = law;
    e.subdomains = std::string(reduction) == "feti" ? 2 : 0;
    Scene scene = cases::make_enf(e);
    scene.text("reduction", reduction);
    scene.text("mixity_rule", "frozen");
    scene.text("minimisation", minimisation);
    scene.text("step_control", "fixed");  // one minimisation a step, by two methods
    scene.number("damage_tolerance", delta);
    scene.number("minimisation_limit", 100000);
    return scene;
}

Watch watch_enf(const LawData& law, int steps, double delta) {
    Watch w;
    w.laws = {law};
    w.times = cases::even_times(cases::enf_end_time, steps);
    w.reaction = "press";
    w.delta = delta;
    return w;
}

// ---- one critical point --------------------------------------------------------------------------------------------

LOOP_TEST(ductile_enf, 0, 2) {
    const double delta = loop == 0 ? 1e-5 : 1e-10;
    const double tolerance = loop == 0 ? 1e-4 : 1e-8;
    Watch w = watch_enf(ductile, 20, delta);
    const auto analyse = [&](const char* reduction, const char* minimisation) {
        const std::string where =
            std::string("ductile ENF, ") + (loop == 0 ? "1e-5, " : "1e-10, ") + reduction + ", " + minimisation;
        const Scene scene = enf(1.5e-3, ductile, reduction, minimisation, delta);
        return cases::watch(scene, w, where);
    };
    const Watched plain = analyse("condensed", "alternate");
    const Watched fast = analyse("condensed", "accelerated");
    const Watched feti = analyse("feti", "accelerated");
    const Watched iterated = analyse("iterated", "accelerated");
    cases::expect_same_analysis(fast, plain, tolerance, "condensed, accelerated");
    cases::expect_same_analysis(iterated, plain, tolerance, "iterated, accelerated");
    cases::expect_same_analysis(feti, plain, tolerance, "feti, accelerated");
    if (loop == 0 && cases::whole())
        cases::expect_same_analysis(analyse("feti", "alternate"), plain, tolerance, "feti, alternate");
    cases::expect_below(fast.alternations, 0.2 * plain.alternations, "alternations of the accelerated analysis");
    cases::expect_below(feti.alternations, 1.2 * fast.alternations, "alternations of the analysis by FETI");
    cases::expect_below(feti.newton, 1.2 * fast.newton, "Newton solves of the analysis by FETI");
    cases::expect_below(iterated.alternations, 1.2 * fast.alternations, "alternations of the iterated analysis");
    // The count includes solves in a part of the bodies; at 1e-10 the last few depend on rounding (131 to 137 beside
    // 67).
    cases::expect_below(iterated.newton, 2.2 * fast.newton, "Newton solves of the iterated analysis");
}

// ---- peeling: mode I, mixed, several interfaces, 3D, all laws -------------------------------------------------------

struct Peel {
    const char* name;
    int dimension;
    int plies;
    double h;
    LawData law;
    double opening, shear;  // m, of the loaded ends
    bool unique;
};

// Plies of 40 mm x 2 mm with a notch of 10 mm in each interface, held at the right end. The bottom and top edges of the
// left end are pulled apart and sideways.
Scene peel(const Peel& p, const char* reduction, const char* minimisation, double delta, double limit = 100000,
           const char* rule = "frozen") {
    constexpr double length = 0.04, width = 0.006, ply = 0.002;
    const int d = p.dimension;
    const auto count = static_cast<std::size_t>(p.plies);
    const auto along = static_cast<std::int64_t>(std::lround(length / p.h));
    Scene scene(d, d == 2 ? std::vector<double>{length} : std::vector<double>{length, width},
                d == 2 ? std::vector<std::int64_t>{along} : std::vector<std::int64_t>{along, 3},
                std::vector<double>(count, ply), std::vector<std::int64_t>(count, d == 2 ? 2 : 1),
                d == 2 ? DELAM_QUAD4 : DELAM_HEX8);
    for (int i = 0; i + 1 < p.plies; ++i) scene.interface(i, i + 1);
    scene.begin();
    scene.elastic(-1, 70e9, 0.3);
    scene.require(delam_problem_set_formulation(scene.problem(), -1, "incompatible"), "formulation");
    for (int i = 0; i + 1 < p.plies; ++i) {
        scene.law(i, p.law);
        std::vector<std::int64_t> open;
        const auto pairs = scene.pairs(i);
        for (std::size_t k = 0; k < pairs.count(); ++k)
            if (scene.coordinate(pairs.node_a[k], 0) < 0.01 - 0.25 * p.h) open.push_back(static_cast<std::int64_t>(k));
        scene.adhesion(i, open, std::vector<double>(open.size(), 0.0));
    }
    const auto end = cases::nodes_where(scene, -1, [&](const double* x) { return x[0] > length - 1e-6; });
    for (int k = 0; k < d; ++k) scene.hold(end, cases::unit(d, k));
    const auto load = scene.pattern("peel", {0.0, 1.0}, {0.0, 1.0});
    const double high = p.plies * ply;
    const auto top =
        cases::nodes_where(scene, p.plies - 1, [&](const double* x) { return x[0] < 1e-6 && x[d - 1] > high - 1e-6; });
    const auto bottom = cases::nodes_where(scene, 0, [&](const double* x) { return x[0] < 1e-6 && x[d - 1] < 1e-6; });
    scene.drive(top, cases::unit(d, d - 1), load, std::vector<double>(top.size(), 0.6 * p.opening));
    scene.drive(bottom, cases::unit(d, d - 1), load, std::vector<double>(bottom.size(), -0.4 * p.opening));
    if (p.shear != 0.0) scene.drive(top, cases::unit(d, 0), load, std::vector<double>(top.size(), p.shear));
    scene.text("reduction", reduction);
    if (std::string(reduction) == "feti") scene.number("subdomains", 3);
    scene.text("mixity_rule", rule);
    scene.text("minimisation", minimisation);
    scene.text("step_control", "fixed");  // one minimisation a step, by two methods
    scene.number("damage_tolerance", delta);
    scene.number("minimisation_limit", limit);
    return scene;
}

const Peel peels[] = {
    {"mode I, ductile", 2, 2, 1e-3, {1e12, 1e12, 50.0, 50.0, 300.0, 300.0}, 4e-4, 0.0, true},
    {"mixed, ductile", 2, 2, 1e-3, {1e12, 5e11, 40.0, 90.0, 250.0, 600.0, 1.3}, 4e-4, -6e-5, true},
    {"two interfaces, ductile", 2, 3, 1e-3, {1e12, 5e11, 40.0, 90.0, 250.0, 600.0}, 5e-4, 0.0, true},
    {"block, ductile", 3, 2, 2e-3, {1e12, 1e12, 50.0, 50.0, 300.0, 300.0}, 4e-4, 3e-5, true},
    {"mode I, brittle", 2, 2, 1e-3, {1e15, 1e15, 0.05, 0.05, 100.0, 100.0}, 4e-4, 0.0, false},
    {"mixed, brittle", 2, 2, 1e-3, {1e15, 4e14, 0.05, 0.09, 100.0, 300.0}, 4e-4, -6e-5, false},
    {"two interfaces, brittle", 2, 3, 2e-3, {1e15, 1e15, 0.05, 0.05, 100.0, 100.0}, 5e-4, 0.0, false},
    {"block, brittle", 3, 2, 2e-3, {1e15, 1e15, 0.05, 0.05, 100.0, 100.0}, 4e-4, 3e-5, false},
    {"Griffith", 2, 2, 1e-3, {1e13, 1e13, 100.0, 100.0, 100.0, 100.0}, 4e-4, 0.0, false},
    {"Griffith, mixed", 2, 2, 1e-3, {1e13, 1e13, 100.0, 200.0, 100.0, 200.0}, 4e-4, -6e-5, false},
    {"Griffith, block", 3, 2, 2e-3, {1e13, 1e13, 100.0, 100.0, 100.0, 100.0}, 4e-4, 3e-5, false},
    {"nearly Griffith",
     2,
     2,
     1e-3,
     {1e13, 1e13, 100.0, 100.0, 100.0 * (1 + 1e-9), 100.0 * (1 + 1e-9)},
     4e-4,
     0.0,
     false},
};
constexpr int peel_count = static_cast<int>(std::size(peels));

void analyse_peel(const Peel& p, int steps, const char* rule) {
    Watch w;
    w.laws = {p.law};
    w.times = cases::even_times(1.0, steps);
    w.reaction = "peel";
    w.delta = 1e-6;
    w.in_parts = std::string(rule) == "converged";
    const auto analyse = [&](const char* reduction, const char* minimisation) {
        const Scene scene = peel(p, reduction, minimisation, w.delta, 100000, rule);
        return cases::watch(scene, w,
                            std::string(p.name) + ", " + rule + ", " + std::to_string(steps) + " steps, " + reduction +
                                ", " + minimisation);
    };
    const Watched plain = analyse("condensed", "alternate");
    const Watched fast = analyse("condensed", "accelerated");
    if (p.unique) cases::expect_same_analysis(fast, plain, 1e-4, p.name);
    cases::expect(fast.steps.back().dissipated > 0.0, std::string(p.name) + ": nothing was damaged");
    if (p.dimension == 3 && !p.unique) return;  // the Krylov solves of long alternations take long
    const Watched feti = analyse("feti", "accelerated");
    if (p.unique) cases::expect_same_analysis(feti, plain, 1e-4, std::string(p.name) + ", feti");
    const Watched iterated = analyse("iterated", "accelerated");
    if (p.unique) cases::expect_same_analysis(iterated, plain, 1e-4, std::string(p.name) + ", iterated");
}

// loop: the scene, then in how many steps the load is applied.
LOOP_TEST(peeling, 0, 2 * peel_count) {
    if ((loop == 2 || loop == 3) && !cases::whole()) return;  // in one step all the same
    analyse_peel(peels[loop % peel_count], loop < peel_count ? 6 : 1, "frozen");
}

// Modes that change while a front grows, which the default rule follows in parts.
LOOP_TEST(peeling_in_parts, 0, 5) {
    const int scenes[] = {1, 2, 3, 5, 9};
    analyse_peel(peels[scenes[loop]], 6, "converged");
}

// ---- many critical points ------------------------------------------------------------------------------------------

LOOP_TEST(brittle_enf, 0, 2) {
    const double h = loop == 0 ? 1e-3 : 0.5e-3;
    const std::string where = std::string("brittle ENF, h = ") + (loop == 0 ? "1 mm" : "0.5 mm");
    const Scene scene = enf(h, brittle, "condensed", "accelerated", 1e-5);
    const Watched fast = cases::watch(scene, watch_enf(brittle, 40, 1e-5), where);
    if (loop == 1) cases::expect_below(fast.newton + fast.solves, 600.0, where + ": linear solves");
    cases::expect(fast.steps.back().dissipated > 0.0, where + ": nothing was damaged");
}

// From the same states both methods end in critical points; their energies are printed, and neither exceeds that of the
// elastic answer.
TEST(brittle_steps_from_the_same_states) {
    const Scene fast = enf(1.5e-3, brittle, "condensed", "accelerated", 1e-5);
    const Scene plain = enf(1.5e-3, brittle, "condensed", "alternate", 1e-5);
    Solver analysis(fast, 0.0);
    int lower = 0, higher = 0, same = 0, steps = 0;
    double time = 0.0;
    for (const double next : cases::even_times(cases::enf_end_time, 40)) {
        const double from = std::exchange(time, next);
        if (steps++ % 4 != 1) {  // every fourth state
            analysis.step(next);
            analysis.commit();
            continue;
        }
        const auto zeta = analysis.field("adhesion");
        double increment[2] = {0.0, 0.0}, scale = 0.0;
        for (const bool accelerated : {true, false}) {
            Solver solver(accelerated ? fast : plain, 0.0);
            solver.equilibrate(from, zeta);
            solver.commit();
            const double before = cases::energy(solver);
            solver.step(next);
            increment[accelerated ? 0 : 1] = cases::energy(solver) - before + solver.value("dissipated");
            scale = std::max(scale, solver.value("stored_bulk"));
        }
        const double difference = (increment[0] - increment[1]) / scale;
        (difference < -1e-7 ? lower : difference > 1e-7 ? higher : same) += 1;
        if (std::abs(difference) > 1e-7)
            std::printf("brittle ENF, step to %.2f: accelerated %.9g, plain %.9g J/m\n", next, increment[0],
                        increment[1]);
        analysis.step(next);
        analysis.commit();
    }
    std::printf("brittle ENF: accelerated lower in %d steps, higher in %d, equal in %d\n", lower, higher, same);
    cases::expect(lower + higher + same == 10, "steps");
}

// ---- counts --------------------------------------------------------------------------------------------------------

TEST(counts_of_the_ductile_analysis) {
    const Scene scene = enf(0.5e-3, ductile, "condensed", "accelerated", 1e-5);
    const Watched w = cases::watch(scene, watch_enf(ductile, 40, 1e-5), "ductile ENF, h = 0.5 mm");
    cases::expect_below(w.newton + w.solves, 260.0, "linear solves");
    cases::expect_below(w.alternations, 100.0, "alternations");
}

// ---- where plain steps end -----------------------------------------------------------------------------------------

// Six elements along, toughness a thousand times the onset: a pair reaches its onset just when the others have settled.
// The returned state must itself be a fixed point, not the one before it.
LOOP_TEST(end_of_plain_alternation, 0, 2) {
    const double k = loop == 0 ? 1e16 : 1e13;
    LawData law{k, k, 5e9 / k, 5e9 / k, 5e12 / k, 5e12 / k};
    Scene scene = cases::make_plies(2, 2, DELAM_QUAD4, "incompatible", law, 6);
    scene.text("minimisation", "alternate");
    scene.number("damage_tolerance", 1e-4);
    scene.number("minimisation_limit", 100000);
    Watch w;
    w.laws = {law};
    w.times = cases::even_times(1.0, 10);
    w.reaction = "bend";
    w.delta = 1e-4;
    cases::watch(scene, w, "plain, k = " + std::to_string(k));
}

// Near a growing mode plain steps get longer; extrapolated, they point backwards, and what they heal or break is worth
// less energy than the rounding of the total. FETI with extrapolation must terminate all the same.
TEST(growing_modes_end) {
    const LawData laws[] = {{5734538321725559.0, 13778830381103614.0, 4.8624263356114658e-07, 7.3025404161363605e-07,
                             1.5554332683917959e-06, 2.4971317961320756e-06, 2.4369361701978729},
                            {49379597056.96315, 153109893828.73068, 0.070690370335389149, 0.047462206736868857,
                             0.070690370335389149, 0.047462206736868857, 1.5998473475606358},
                            {29172172683641416.0, 26187008091673360.0, 3.4512487763045782e-06, 4.8502278682681118e-06,
                             0.00026952607336923367, 0.00071176813629736195, 1.1370595918293536}};
    Scene scene = cases::make_plies(2, 4, DELAM_QUAD4, "incompatible", laws[0], 30);
    for (int i = 0; i < 3; ++i) scene.law(i, laws[i]);
    scene.text("reduction", "feti");
    scene.number("subdomains", 4);
    scene.text("mixity_rule", "frozen");
    scene.number("damage_tolerance", 9.1657185711429935e-06);
    scene.number("minimisation_limit", 1000);
    Watch w;
    w.laws = {laws[0], laws[1], laws[2]};
    w.times = cases::even_times(1.0, 3);
    w.reaction = "bend";
    w.delta = 9.1657185711429935e-06;
    cases::watch(scene, w, "growing modes");
}

// ---- limits --------------------------------------------------------------------------------------------------------

LOOP_TEST(few_alternations, 0, 12) {
    const double limit = std::array{1.0, 2.0, 5.0}[static_cast<std::size_t>(loop) % 3];
    const char* reduction = loop / 3 == 0 ? "condensed" : "feti";
    Peel p = peels[loop / 6 == 0 ? 4 : 0];
    const std::string where = std::string(reduction) + ", limit " + std::to_string(limit);
    // Newton's method may need only one or two rounds.
    const Scene scene = peel(p, reduction, "accelerated", 1e-9, limit);
    Solver solver(scene, 0.0);
    const reference::Exported exported(scene);
    const std::int32_t status = solver.advance(1.0);
    cases::expect(status == DELAM_NOT_CONVERGED || (status == DELAM_OK && limit > 1.0),
                  where + ": " + delam_status_name(status));
    cases::expect_below(solver.value("am_iterations"), limit, where + ": alternations");
    const auto accepted = reference::accept(solver, exported);
    cases::expect_below(accepted.worst(), 1e-10, where + ": " + accepted.text());
    cases::expect_below(solver.value("increment") - solver.value("upper"), 1e-9 * std::abs(solver.value("upper")),
                        where + ": increment");
    for (const double zeta : solver.field("adhesion")) cases::expect(zeta >= 0.0 && zeta <= 1.0, where + ": adhesion");
    solver.commit();
    // The analysis continues from it.
    const std::int32_t next = solver.advance(1.1);
    cases::expect(next == DELAM_OK || next == DELAM_NOT_CONVERGED, where + ", next step: " + delam_status_name(next));
    cases::expect_below(reference::accept(solver, exported).worst(), 1e-10, where + ", next step");
}

}  // namespace
