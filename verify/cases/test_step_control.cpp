// SPDX-License-Identifier: BSD-3-Clause
// Steps in parts: jumps where they are and nowhere else, energies that balance over the parts, refusals that terminate,
// and calls that are cancelled at any place.
#include <cstring>
#include <numeric>

#include "energetic_scenes.hpp"
#include "flexure.hpp"
#include "mmf.hpp"
#include "small_analysis.hpp"

namespace {

using cases::Beam;
using cases::Block;
using cases::Jump;
using cases::jumps;
using reference::Scene;
using reference::Solver;

double size_of(const Solver& s) { return std::max(cases::scale(s), 1e-12); }

// The ledger of an analysis in parts before a step.
struct Before {
    double energy, dissipated, work, defect;
    explicit Before(const Solver& s)
        : energy(cases::stored(s)),
          dissipated(s.value("dissipated")),
          work(s.value("work")),
          defect(s.value("defect")) {}
};

// The sums over the parts are those of the whole: what the loads do is stored, dissipated or released, but for the
// error of the trapezoidal rule, which is the defect; their work is within the bounds, which add up too.
void expect_ledger_close(const Solver& s, const Before& before, const std::string& where) {
    const double change = cases::stored(s) - before.energy + s.value("dissipated") - before.dissipated;
    const double work = s.value("work") - before.work;
    cases::expect_near(s.value("increment"), change, 1e-9, size_of(s), where + "increment");
    cases::expect_near(s.value("defect") - before.defect, change + s.value("released") - work, 1e-9, size_of(s),
                       where + "defect");
    cases::expect_below(work - s.value("upper"), 1e-8 * size_of(s), where + "work above its bound");
    cases::expect_below(s.value("lower") - work, 1e-8 * size_of(s), where + "work below its bound");
    cases::expect_below(s.value("increment") - s.value("upper"), 1e-8 * size_of(s), where + "upper bound");
    cases::expect(s.value("released") >= 0.0, where + "released");
    cases::expect(s.value("substeps") >= 1.0, where + "parts");
}

// Jumps of the pending step, in order, inside it, with their own energies. alone: nothing else in the step damages a
// pair abruptly, so that only the jumps release energy.
void expect_jumps(const Solver& s, double from, const std::string& where, bool alone = false) {
    const double to = s.value("time");
    double released = 0.0, n = 0.0, last = from;
    for (const Jump& j : jumps(s)) {
        if (static_cast<double>(j.step) != s.value("step")) continue;
        ++n;
        released += j.released;
        cases::expect(j.before >= last && j.time > j.before && j.time <= to, where + "instants in order");
        last = j.time;
        cases::expect(j.dissipated > 0.0 && j.debonded > 0.0 && j.first >= 0 && j.last >= j.first,
                      where + "something broke");
        cases::expect_below(j.stored, 1e-6 * size_of(s), where + "a jump stores nothing");
        cases::expect_below(-j.released, 1e-8 * size_of(s), where + "a jump creates energy");
    }
    cases::expect(n == s.value("jumps"), where + "count of jumps");
    cases::expect_below(released - s.value("released"), 1e-12 * size_of(s), where + "released by the jumps");
    if (alone) cases::expect_near(s.value("released"), released, 1e-12, size_of(s), where + "released");
}

// A block that separates: at its two closed-form loads, to the tolerance, whatever the steps.
LOOP_TEST(block_jumps_where_it_should, 0, 6) {
    Block b;
    b.cells = 3;
    b.stiffness = 1e12;
    const bool energetic = loop % 2 == 0;
    const double local = std::sqrt(2.0 * b.stiffness * cases::toughness) * (1.0 / b.spring + 1.0 / b.stiffness);
    const double exact = energetic ? cases::energetic_load(b) : local;
    b.end = 1.31 * exact;
    const double tolerance = loop < 2 ? 1e-2 : 1e-6;
    const int steps = loop < 4 ? 3 : 1;
    Scene scene = cases::make_block(b);
    if (energetic) cases::set_energetic(scene);
    scene.number("jump_tolerance", tolerance);
    Solver solver(scene, 0.0);
    for (int k = 1; k <= steps; ++k) {
        const Before before(solver);
        solver.step(static_cast<double>(k) / steps);
        const std::string where = "step " + std::to_string(k) + ": ";
        expect_ledger_close(solver, before, where);
        expect_jumps(solver, static_cast<double>(k - 1) / steps, where, true);
        solver.commit();
    }
    const auto all = jumps(solver);
    cases::expect(all.size() == 1, "one jump, not " + std::to_string(all.size()));
    cases::expect(all[0].before * b.end <= exact * (1 + 1e-9) && all[0].time * b.end >= exact * (1 - 1e-9),
                  "the jump brackets its closed form");
    cases::expect_below(all[0].time - all[0].before, tolerance / steps * (1 + 1e-9), "width of the bracket");
    const double spent = cases::toughness * b.width;
    const double release =
        energetic ? 0.0 : 0.5 * local * local / (1.0 / b.spring + 1.0 / b.stiffness) * b.width - spent;
    cases::expect_near(all[0].dissipated, spent, 1e-9, spent, "dissipated");
    cases::expect_near(all[0].released, release, 6.0 * tolerance, spent + release, "released");
    cases::expect_near(all[0].debonded, b.width, 1e-9, b.width, "debonded");
    cases::expect(all[0].interface == 0 && all[0].first == 0 && all[0].last == 3, "all pairs");
    // Work up to the jump and none after: E(jump) = dissipated + released.
    cases::expect_near(solver.value("work"), spent + release, 12.0 * tolerance, spent + release, "work");
}

// Damage that grows steadily is no jump, however fine or coarse the tolerance.
LOOP_TEST(smooth_analysis_has_no_jump, 0, 4) {
    const double tolerance[] = {0.2, 0.1, 1e-2, 1e-3};
    reference::Flexure data = reference::find_flexure("enf-ductile");
    data.law.exponent = 1.0;
    data.h = 1e-3;
    reference::FlexureScene f = reference::make_flexure(data);
    f.scene.number("jump_tolerance", tolerance[loop]);
    f.scene.number("jump_size", 0.5);
    Solver solver(f.scene, 0.0);
    double spent = 0.0, released = 0.0;
    for (int k = 1; k <= 20; ++k) {
        const Before before(solver);
        solver.step(2.0 * k / 20);
        expect_ledger_close(solver, before, "step " + std::to_string(k) + ": ");
        expect_jumps(solver, 2.0 * (k - 1) / 20, "step " + std::to_string(k) + ": ");
        solver.commit();
        spent = solver.value("dissipated");
        released += solver.value("released");
        if (spent == 0.0) cases::expect(jumps(solver).empty(), "a jump before any damage");
    }
    cases::expect(spent > 0.0, "something is damaged");
    cases::expect_below(released, 1e-3 * solver.value("work"), "released by a ductile front");
    cases::expect(jumps(solver).empty(), "jumps of a ductile front: " + std::to_string(jumps(solver).size()));
    // Nor is that of a stiff spring.
    Block b;
    b.cells = 3;
    b.spring = 4e12;
    b.stiffness = 125e9;
    b.end = 2.0e-4;
    Scene scene = cases::make_block(b);
    const double go = 100.0, gc = 250.0;
    scene.law(0, {b.stiffness, b.stiffness, go, go, gc, gc, 1.0});
    scene.number("jump_tolerance", tolerance[loop]);
    scene.number("damage_tolerance", 1e-10);
    Solver spring(scene, 0.0);
    for (int k = 1; k <= 5; ++k) {
        const Before before(spring);
        spring.step(k / 5.0);
        expect_ledger_close(spring, before, "spring, step " + std::to_string(k) + ": ");
        spring.commit();
    }
    cases::expect_near(spring.value("dissipated"), gc * b.width, 1e-6, gc * b.width, "the spring's bond is spent");
    cases::expect(jumps(spring).empty(), "jumps of a stable spring: " + std::to_string(jumps(spring).size()));
}

// Jumps of the flexure test: the energy that they release, and the balance of an analysis with many of them.
LOOP_TEST(jumps_of_a_flexure, 0, 2) {
    const bool energetic = loop == 0;
    reference::Flexure data = reference::find_flexure("enf-brittle");
    if (energetic) data.h = cases::whole() ? 1.5e-3 : 3e-3;
    reference::FlexureScene f = reference::make_flexure(data);
    if (energetic) f.scene.text("solution", "energetic");
    f.scene.text("backtracking", "off");
    f.scene.text("mixity_rule", "frozen");
    f.scene.number("jump_tolerance", 1e-3);
    Solver solver(f.scene, 0.0);
    double released = 0.0, parts = 0.0;
    const int steps = energetic ? 12 : 20;
    for (int k = 1; k <= steps; ++k) {
        const Before before(solver);
        solver.step(2.0 * k / steps);
        const std::string where = "step " + std::to_string(k) + ": ";
        expect_ledger_close(solver, before, where);
        expect_jumps(solver, 2.0 * (k - 1) / steps, where);
        released += solver.value("released");
        parts += solver.value("substeps");
        if (k == 1 || k == steps) {  // rolled back, without a trace
            const auto bits = cases::read_bits(solver);
            const auto count = jumps(solver).size();
            solver.rollback();
            solver.step(2.0 * k / steps);
            cases::expect_same(solver, cases::read_bits(solver), bits, where + "taken again");
            cases::expect(jumps(solver).size() == count, where + "jumps taken again");
        }
        solver.commit();
    }
    cases::expect(!jumps(solver).empty(), "a jump");
    cases::expect(parts > steps, "steps were walked in parts");
    // The work that was neither stored nor dissipated was released.
    const double missing = solver.value("work") - cases::stored(solver) - solver.value("dissipated");
    cases::expect_near(missing, released, 2e-2, solver.value("work"), "work less stored and dissipated");
    if (!energetic) cases::expect(released > 0.1 * solver.value("dissipated"), "a local jump releases energy");
    // Jumps survive saving, and setting a state.
    const auto before = jumps(solver);
    Solver again(f.scene, 0.0);
    f.scene.require(again.load(solver.save()), "delam_solver_load");
    cases::expect(jumps(again).size() == before.size() && jumps(again)[0].time == before[0].time, "jumps are saved");
    again.equilibrate(again.value("time"), again.field("adhesion"));
    cases::expect(jumps(again).size() == before.size(), "jumps while a set state is pending");
    again.commit();
    cases::expect(jumps(again).size() == before.size(), "jumps of the analysis after a set state is committed");
}

bool open() { return std::getenv("DELAM_OPEN_TESTS") != nullptr; }

// The energy that is missing in the ledger was released, also where a local front jumps by cells so regularly that the
// jumps count as growth (loop 1). Known open problem (DELAM_OPEN_TESTS=1 runs it): not where a step was replaced after
// a return, because its jumps are not located, and the trapezoidal rule does not see when they come (loop 0).
LOOP_TEST(all_that_is_missing_was_released, open() ? 0 : 1, 2) {
    if (!open()) std::printf("open, left out: all_that_is_missing_was_released (0)\n");
    reference::FlexureScene f = reference::make_flexure(reference::find_flexure("enf-brittle"));
    f.scene.text("backtracking", loop == 0 ? "on" : "off");
    f.scene.text("mixity_rule", "frozen");
    f.scene.number("jump_tolerance", 1e-3);
    Solver solver(f.scene, 0.0);
    double released = 0.0;
    const int steps = 20;
    for (int k = 1; k <= steps; ++k) {
        solver.step(2.0 * k / steps);
        solver.commit();
        if (loop == 1) released += solver.value("released");
    }
    for (int k = 1; loop == 0 && k <= steps; ++k) {
        REQUIRE(f.scene, delam_solver_look, solver.get(), k);
        released += solver.value("released");
    }
    REQUIRE(f.scene, delam_solver_look, solver.get(), -1);
    const double missing = solver.value("work") - cases::stored(solver) - solver.value("dissipated");
    std::printf("brittle ENF, backtracking %s: released %.5g, missing %.5g, work %.5g\n", loop == 0 ? "on" : "off",
                released, missing, solver.value("work"));
    cases::expect_near(solver.value("defect"), released - missing, 1e-9, solver.value("work"), "defect");
    cases::expect_near(released, missing, 0.02, missing, "released, of what is missing");
}

// ---- refusals -----------------------------------------------------------------------------------------------------

TEST(steps_that_do_not_converge_are_cut) {
    Scene fixed = cases::small_enf(0), adaptive = cases::small_enf(0), stubborn = cases::small_enf(0);
    for (Scene* s : {&fixed, &adaptive, &stubborn}) {
        s->text("minimisation", "alternate");
        s->number("minimisation_limit", 15);
        s->number("step_tolerance", 0.9999);
    }
    adaptive.text("step_control", "adaptive");
    stubborn.text("step_control", "adaptive");
    stubborn.number("smallest_step", 0.25);
    stubborn.number("minimisation_limit", 2);
    Solver a(fixed, 0.0), b(adaptive, 0.0), c(stubborn, 0.0);
    int failed = 0, failed_adaptive = 0;
    double refused = 0.0;
    for (int k = 1; k <= 8; ++k) {
        const double time = cases::enf_time(k, 16);
        failed += a.advance(time) == DELAM_NOT_CONVERGED ? 1 : 0;
        const Before before(b);
        failed_adaptive += b.advance(time) == DELAM_NOT_CONVERGED ? 1 : 0;
        expect_ledger_close(b, before, "adaptive, step " + std::to_string(k) + ": ");
        refused += b.value("refused_steps");
        const std::int32_t status = c.advance(time);
        stubborn.require(status < 0 ? status : 0, "delam_solver_advance");
        cases::expect_below(c.value("substeps"), 4.0, "parts that are shorter than smallest_step");
        for (Solver* s : {&a, &b, &c}) s->commit();
    }
    std::printf("not converged: fixed %d, adaptive %d of 8 steps, %g refused\n", failed, failed_adaptive, refused);
    cases::expect(failed > failed_adaptive && refused > 0.0,
                  "cutting helps: " + std::to_string(failed) + " or " + std::to_string(failed_adaptive));
    cases::expect(failed_adaptive == 0, "all parts converge");
}

// A step whose bounds are wide is divided until they are not.
TEST(wide_estimates_are_cut) {
    Beam b;
    b.press = 1e-3;
    Scene scene = cases::make_beam(b);
    scene.text("step_control", "adaptive");
    scene.number("step_tolerance", 0.5);
    scene.number("smallest_step", 1.0 / 64.0);
    Solver solver(scene, 0.0);
    for (int k = 1; k <= 3; ++k) {
        const Before before(solver);
        solver.step(k / 3.0);
        expect_ledger_close(solver, before, "step " + std::to_string(k) + ": ");
        cases::expect_below(solver.value("substeps"), 64.0, "parts that are shorter than smallest_step");
        solver.commit();
    }
}

TEST(snapping_steps_are_cut) {
    Scene scene = cases::make_mmf(1e-3, cases::mmf_ductile, "frozen");
    const double tolerance = 0.05, smallest = 1.0 / 256.0;
    scene.number("mixity_step_tolerance", tolerance);
    scene.number("smallest_step", smallest);
    Solver solver(scene, 0.0);
    double worst = 0.0, parts = 0.0;
    const int steps = 40;
    for (int k = 1; k <= steps; ++k) {
        const Before before(solver);
        solver.step(2.0 * k / steps);
        expect_ledger_close(solver, before, "step " + std::to_string(k) + ": ");
        cases::expect(solver.value("mixity_error") <= tolerance || solver.value("substeps") > 8.0,
                      "a step that snaps is cut as far as allowed");
        cases::expect_below(solver.value("substeps"), 1.0 / smallest, "parts that are shorter than smallest_step");
        worst = std::max(worst, solver.value("mixity_error"));
        parts = std::max(parts, solver.value("substeps"));
        solver.commit();
    }
    std::printf("ductile MMF cut at a mixity error of %g: worst %.3g, %g parts at most, %.5g J/m\n", tolerance, worst,
                parts, solver.value("dissipated"));
}

// ---- cancelled ----------------------------------------------------------------------------------------------------

struct Countdown {
    std::int64_t left;
    bool search_only;
    std::int64_t seen = 0;
    static std::int32_t hear(const char* stage, std::int64_t, std::int64_t, void* user) {
        auto* c = static_cast<Countdown*>(user);
        if (c->search_only && std::strcmp(stage, "search") != 0) return 0;
        ++c->seen;
        return c->left > 0 && --c->left == 0 ? 1 : 0;
    }
};

LOOP_TEST(cancelled_anywhere, 0, 4) {
    Beam b;
    b.h = 3e-3;
    Scene scene = cases::make_beam(b);
    cases::set_energetic(scene, 1e-2);
    scene.text("reduction", loop % 2 == 0 ? "condensed" : "feti");
    scene.number("jump_tolerance", loop < 2 ? 0.05 : 0.0);
    Solver solver(scene, 0.0);
    solver.step(0.2);
    solver.commit();
    const auto bits = cases::read_bits(solver);
    const auto bytes = solver.save();
    const auto known = jumps(solver).size();
    Countdown all{0, false}, search{0, true};
    REQUIRE(scene, delam_context_set_progress, scene.context(), &Countdown::hear, &all);
    solver.step(0.8);
    const auto pending = cases::read_bits(solver);
    const auto found = jumps(solver).size();
    solver.rollback();
    REQUIRE(scene, delam_context_set_progress, scene.context(), &Countdown::hear, &search);
    solver.step(0.8);
    cases::expect_same(solver, cases::read_bits(solver), pending, "taken again");
    solver.rollback();
    cases::expect(search.seen > 0 && all.seen > search.seen, "the search reports itself");
    for (const bool only : {false, true}) {
        const std::int64_t seen = only ? search.seen : all.seen;
        for (std::int64_t stop = 1; stop <= seen; stop += 1 + seen / 7) {
            Countdown c{stop, only};
            REQUIRE(scene, delam_context_set_progress, scene.context(), &Countdown::hear, &c);
            const std::string where =
                std::string(only ? "search " : "") + "call " + std::to_string(stop) + " of " + std::to_string(seen);
            cases::expect(solver.advance(0.8) == DELAM_CANCELLED, where + ": cancelled");
            cases::expect(jumps(solver).size() == known, where + ": no jump is left");
            cases::expect(solver.save() == bytes, where + ": bytes as before");
            cases::expect_same(solver, cases::read_bits(solver), bits, where);
        }
    }
    REQUIRE(scene, delam_context_set_progress, scene.context(), nullptr, nullptr);
    solver.step(0.8);
    cases::expect_same(solver, cases::read_bits(solver), pending, "after all cancelled ones");
    cases::expect(jumps(solver).size() == found, "jumps after all cancelled ones");
}

}  // namespace
