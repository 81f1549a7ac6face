// SPDX-License-Identifier: BSD-3-Clause
// Returns to earlier steps by the two-sided estimate: what they achieve, that the resulting history is consistent, and
// that it can be rolled back, saved and cut like any other.
#include "energetic_scenes.hpp"
#include "flexure.hpp"
#include "mmf.hpp"
#include "small_analysis.hpp"
#include "step_ledger.hpp"

namespace {

using reference::FlexureScene;
using reference::Solver;

constexpr double eta = 1e-3;

reference::Flexure brittle(double exponent = 1.0) {
    reference::Flexure data = reference::find_flexure("enf-brittle");
    data.h = 1.5e-3;
    data.law.exponent = exponent;
    return data;
}
FlexureScene make(const reference::Flexure& data, const char* backtracking, const char* solution = "local") {
    FlexureScene f = reference::make_flexure(data);
    f.scene.text("backtracking", backtracking);
    f.scene.text("solution", solution);
    return f;
}
double time_of(int k, int steps) { return 2.0 * k / steps; }

void select_step(const Solver& solver, int step) { REQUIRE(solver.scene(), delam_solver_look, solver.get(), step); }

// The values of a step, as a host reads them.
cases::StepLedger read(const Solver& s, int k, int steps) {
    return cases::read_ledger(s, "press", 0.5 * cases::enf_final_load * time_of(k, steps));
}
// of: the number of steps of the whole analysis.
std::vector<cases::StepLedger> history(const Solver& solver, int steps, int of) {
    std::vector<cases::StepLedger> rows;
    for (int k = 0; k <= steps; ++k) {
        select_step(solver, k);
        rows.push_back(read(solver, k, of));
    }
    select_step(solver, -1);
    return rows;
}
int violated(const std::vector<cases::StepLedger>& rows) {
    int n = 0;
    for (const cases::StepLedger& r : rows) n += r.lower - r.increment > eta * r.size() ? 1 : 0;
    return n;
}
int first_break(const std::vector<cases::StepLedger>& rows, double least = 1e-3) {
    int k = 0;
    while (k < static_cast<int>(rows.size()) && rows[static_cast<std::size_t>(k)].dissipated < least) ++k;
    return k;
}
// variational: the increment is that of the ledger of PANM 15 (2010).
void expect_one_history(const std::vector<cases::StepLedger>& rows, const reference::LawData& law,
                        const std::string& where, const std::string& rule = "frozen") {
    for (std::size_t k = 1; k < rows.size(); ++k) {
        const cases::StepLedger &a = rows[k - 1], &b = rows[k];
        const std::string step = where + ", step " + std::to_string(k) + ": ";
        if (rule != "variational")
            cases::expect_near(b.energy - a.energy + b.dissipated - a.dissipated, b.increment, 1e-10, b.size(),
                               step + "increment");
        cases::expect_work(law, a, b, 1e-9, b.size(), step, rule == "converged");
        for (std::size_t p = 0; p < a.adhesion.size(); ++p)
            cases::expect(b.adhesion[p] <= a.adhesion[p], step + "adhesion grows");
    }
}
// Runs to `steps` and, with a law, checks every pending history for consistency. Returns the number of returns. idle: a
// return may find nothing lower; without one, the lower bound was missed for a reason, and steps are replaced.
double walk(Solver& solver, int first, int last, int steps, const reference::LawData* check = nullptr,
            bool idle = false) {
    double returns = 0.0;
    for (int k = first; k <= last; ++k) {
        const std::int32_t status = solver.advance(time_of(k, steps));
        solver.scene().require(status < 0 ? status : 0, "delam_solver_advance");
        returns += solver.value("backtracks");
        const double from = solver.value("revised_from");
        const bool returned = solver.value("backtracks") > 0.0;
        cases::expect(from <= k && (from == k || returned) && (from < k || !returned || idle),
                      "revised_from of step " + std::to_string(k));
        if (from == k && returned)
            cases::expect(solver.value("lower") > solver.value("increment"),
                          "a return without a missed bound in step " + std::to_string(k));
        if (check != nullptr && from < k) {
            expect_one_history(history(solver, k, steps), *check, "pending at " + std::to_string(k));
            for (int j = static_cast<int>(from); j < k; ++j) {
                select_step(solver, j);
                cases::expect(solver.value("revisions") >= 1.0, "a replaced step says so");
                cases::expect(solver.value("step") == j && std::abs(solver.value("time") - time_of(j, steps)) < 1e-12,
                              "step and time");
            }
            select_step(solver, -1);
        }
        solver.commit();
    }
    return returns;
}

LOOP_TEST(no_bound_is_missed_afterwards, 0, 4) {
    const int steps = loop % 2 == 0 ? 80 : 40;
    const double exponent = loop < 2 ? 1.0 : 2.0;
    const FlexureScene off = make(brittle(exponent), "off"), on = make(brittle(exponent), "on");
    std::vector<cases::StepLedger> plain{cases::StepLedger{}};
    Solver a(off.scene, 0.0), b(on.scene, 0.0);
    for (int k = 1; k <= steps; ++k) {
        a.step(time_of(k, steps));
        a.commit();
        plain.push_back(read(a, k, steps));
    }
    cases::expect(violated(plain) > 0, "a local analysis misses bounds");
    cases::expect(walk(b, 1, steps, steps, &on.data.law) > 0.0, "and is returned in");
    const auto rows = history(b, steps, steps);
    expect_one_history(rows, on.data.law, "in the end");
    cases::expect_below(violated(rows), 0, "bounds missed after returning");
    cases::expect(first_break(rows) < first_break(plain), "the jump is earlier than the local one");
}

// Each kept step alone: displacements at its adhesion have its energy; the energy of its adhesion is what was
// dissipated.
TEST(replaced_steps_hold_on_their_own) {
    const int steps = 40;
    const FlexureScene on = make(brittle(), "on");
    Solver b(on.scene, 0.0), probe(on.scene, 0.0);
    walk(b, 1, steps, steps);
    for (int k = 1; k <= steps; ++k) {
        select_step(b, k);
        const auto adhesion = b.field("adhesion");
        const auto displacement = b.field("displacement");
        probe.equilibrate(time_of(k, steps), adhesion);
        const std::string where = "step " + std::to_string(k) + ": ";
        cases::expect_near(cases::stored(b), cases::stored(probe), 1e-9, std::abs(cases::stored(probe)),
                           where + "energy");
        cases::expect_near(b.value("reaction:press"), probe.value("reaction:press"), 1e-8,
                           std::abs(probe.value("reaction:press")), where + "reaction");
        const auto again = probe.field("displacement");
        for (std::size_t i = 0; i < again.size(); ++i)
            cases::expect_near(displacement[i], again[i], 1e-7, 6e-3, where + "displacement");
        probe.rollback();
        double spent = 0.0;
        for (std::size_t p = 0; p < adhesion.size(); ++p)
            spent += on.data.law.tangential_toughness * on.weight[p] * (on.adhesion[p] - adhesion[p]);
        cases::expect_near(b.value("dissipated"), spent, 1e-9, spent + 1e-3, where + "dissipated");
    }
}

// ---- rolled back, saved, read again -------------------------------------------------------------------------------

const char* concept_of(int loop) { return loop == 0 ? "local" : "energetic"; }

// The step of an analysis that makes the first return; 0: none.
int first_return(const FlexureScene& f, int steps) {
    Solver solver(f.scene, 0.0);
    for (int k = 1; k <= steps; ++k) {
        solver.step(time_of(k, steps));
        if (solver.value("backtracks") > 0.0) return k;
        solver.commit();
    }
    return 0;
}

LOOP_TEST(rollback_of_a_return, 0, 2) {
    const int steps = 40;
    const FlexureScene f = make(brittle(2.0), "on", concept_of(loop));
    int k = first_return(f, steps);
    cases::expect(loop == 1 || k > 1, "a return");
    if (k == 0) k = 2;
    Solver solver(f.scene, 0.0);
    walk(solver, 1, k - 1, steps);
    const auto bits = cases::read_bits(solver);
    const auto bytes = solver.save();
    solver.step(time_of(k, steps));
    const auto pending = cases::read_bits(solver);
    cases::expect(solver.save() == bytes, "what a return replaces is not saved before it is committed");
    solver.rollback();
    cases::expect_same(solver, cases::read_bits(solver), bits, "after rollback");
    cases::expect(solver.save() == bytes, "bytes after rollback");
    for (int j = 1; j < k; ++j) {
        select_step(solver, j);
        cases::expect(solver.value("revisions") == 0.0, "no step has been replaced");
    }
    // A further step, rolled back too, must leave no trace.
    solver.step(time_of(k + 3, steps));
    solver.rollback();
    solver.step(time_of(k, steps));
    cases::expect_same(solver, cases::read_bits(solver), pending, "taken again");
}

LOOP_TEST(resumed_analysis, 0, 2) {
    const int steps = 40;
    const FlexureScene f = make(brittle(2.0), "on", concept_of(loop));
    const int k = std::max(2, first_return(f, steps));
    for (const int cut : {k - 1, k, k + 2}) {
        Solver whole(f.scene, 0.0);
        walk(whole, 1, cut, steps);
        const auto bytes = whole.save();
        const FlexureScene g = make(brittle(2.0), "on", concept_of(loop));
        Solver resumed(g.scene, 0.0);
        g.scene.require(resumed.load(bytes), "delam_solver_load");
        cases::expect(resumed.save() == bytes, "saving what was loaded");
        for (int j = cut + 1; j <= k + 4; ++j) {
            walk(whole, j, j, steps);
            walk(resumed, j, j, steps);
            cases::expect_same(resumed, cases::read_bits(resumed), cases::read_bits(whole),
                               "cut at " + std::to_string(cut) + ", step " + std::to_string(j));
        }
        cases::expect(resumed.save() == whole.save(), "bytes in the end");
        for (int j = 0; j <= k + 4; ++j) {
            select_step(whole, j);
            select_step(resumed, j);
            cases::expect_same(resumed, cases::read_bits(resumed), cases::read_bits(whole),
                               "selected, step " + std::to_string(j));
        }
    }
}

TEST(limits_and_depth) {
    const int steps = 40;
    const reference::Flexure data = brittle(2.0);
    FlexureScene off = make(data, "off"), none = make(data, "on"), one = make(data, "on"), shallow = make(data, "on");
    none.scene.number("backtracking_limit", 0);
    one.scene.number("backtracking_limit", 1);
    shallow.scene.number("backtracking_depth", 1);
    Solver a(off.scene, 0.0), b(none.scene, 0.0), c(one.scene, 0.0), d(shallow.scene, 0.0);
    double returns = 0.0;
    for (int k = 1; k <= steps; ++k) {
        for (Solver* s : {&a, &b, &c, &d}) s->step(time_of(k, steps));
        cases::expect(delam::same_bits(a.field("adhesion"), b.field("adhesion")) && b.value("backtracks") == 0.0,
                      "limit 0 never returns");
        cases::expect_below(c.value("backtracks"), 1.0, "limit 1");
        returns += c.value("backtracks");
        cases::expect(d.value("revised_from") >= k - 1, "one step is kept to return to");
        for (Solver* s : {&a, &b, &c, &d}) s->commit();
        cases::expect(delam_solver_look(d.get(), k - 2) == DELAM_ERROR_ARGUMENT || k < 2, "two steps back is not kept");
        cases::expect(delam_solver_look(d.get(), k - 1) == DELAM_OK && delam_solver_look(d.get(), -1) == DELAM_OK,
                      "the last one is");
        cases::expect(delam_solver_look(a.get(), k - 1) == DELAM_ERROR_ARGUMENT, "without backtracking none is kept");
        cases::expect(delam_solver_look(d.get(), k + 1) == DELAM_ERROR_ARGUMENT &&
                          delam_solver_look(d.get(), -2) == DELAM_ERROR_ARGUMENT,
                      "no step beyond");
    }
    cases::expect(returns > 0.0, "limit 1 returns");
    expect_one_history(history(c, steps, steps), data.law, "limit 1");
}

// A state set by the host is no step: a later return must not undo it.
TEST(a_set_state_is_kept) {
    const int steps = 40;
    FlexureScene f = make(brittle(2.0), "on");
    const int k = first_return(f, steps);
    Solver solver(f.scene, 0.0);
    walk(solver, 1, k - 1, steps);
    auto adhesion = solver.field("adhesion");
    for (std::size_t p = 0; p < adhesion.size(); ++p)
        if (f.position[p] > 0.110) adhesion[p] = 0.0;  // a crack that no analysis makes
    solver.equilibrate(time_of(k - 1, steps), adhesion);
    solver.commit();
    solver.step(time_of(k, steps));
    const auto now = solver.field("adhesion");
    for (std::size_t p = 0; p < now.size(); ++p)
        cases::expect(now[p] <= adhesion[p], "what was set broken is whole again at pair " + std::to_string(p));
}

// Laws that soften, analyses that return many times, every rule: the loops terminate.
LOOP_TEST(returns_end, 0, 6) {
    const char* rules[] = {"frozen", "converged", "variational"};
    reference::Scene scene = cases::make_mmf(1.5e-3, cases::mmf_ductile, rules[loop % 3]);
    scene.text("backtracking", "on");
    if (loop >= 3) scene.number("backtracking_tolerance", 1e-9);
    Solver solver(scene, 0.0);
    const int steps = 40;
    const double returns = walk(solver, 1, steps, steps, nullptr, true);
    expect_one_history(history(solver, steps, steps), cases::mmf_ductile, rules[loop % 3], rules[loop % 3]);
    std::printf("ductile MMF, %s: %g returns, %d bounds missed\n", rules[loop % 3], returns,
                violated(history(solver, steps, steps)));
}

// Fine analyses of the mixed-mode flexure test with returns (long tier): the loops terminate, and the results satisfy
// the same checks as without returns.
LOOP_TEST(returns_of_fine_analyses_end, 0, 6) {
    if (!cases::whole()) return;
    const char* rules[] = {"frozen", "converged", "variational"};
    const bool brittle = loop >= 3;
    const int steps = 320;
    reference::LawData law = brittle ? cases::mmf_brittle : cases::mmf_ductile;
    if (loop == 5) {  // the variational rule allows the toughness to vary by twice the onset
        law.tangential_toughness += 2.0 * law.normal_onset;
        law.exponent = 1.0;
    }
    reference::Scene scene = cases::make_mmf(1e-3, law, rules[loop % 3]);
    scene.text("backtracking", "on");
    scene.number("backtracking_tolerance", loop == 0 ? 1e-6 : 1e-3);
    // A brittle front that jumps late returns to where the bound is first missed, over a hundred steps.
    const double limit = 300.0;
    scene.number("backtracking_limit", limit);
    Solver solver(scene, 0.0);
    double returns = 0.0, most = 0.0;
    for (int k = 1; k <= steps; ++k) {
        const std::int32_t status = solver.advance(cases::enf_time(k, steps));
        scene.require(status < 0 ? status : 0, "delam_solver_advance");
        returns += solver.value("backtracks");
        most = std::max(most, solver.value("backtracks"));
        solver.commit();
    }
    int violated = 0;
    for (int k = 1; k <= steps; ++k) {
        REQUIRE(scene, delam_solver_look, solver.get(), k);
        const double size = std::max(std::abs(solver.value("stored_bulk")), solver.value("work"));
        violated += solver.value("lower") - solver.value("increment") > 1e-3 * size ? 1 : 0;
    }
    std::printf("MMF, %s, %s: %g returns, at most %g in a step, %d bounds missed, %.5g J/m\n",
                brittle ? "brittle" : "ductile", rules[loop % 3], returns, most, violated, solver.value("dissipated"));
    cases::expect_below(most, limit - 1.0, "returns in a step: the limit ended them");
    if (!brittle) cases::expect(violated == 0, "bounds missed: " + std::to_string(violated));
    cases::expect(solver.value("dissipated") > 0.0, "something breaks");
}

}  // namespace
