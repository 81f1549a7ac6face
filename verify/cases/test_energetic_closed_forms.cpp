// SPDX-License-Identifier: BSD-3-Clause
// Closed forms of local and energetic solutions: when a spring in series with an interface lets go, and how far a bar
// peels off a rigid base.
#include <algorithm>

#include "bonded_bar.hpp"
#include "support.hpp"

namespace {

using reference::Scene;
using reference::Solver;

// ---- spring K in series with a bilinear law ------------------------------------------------------------------------

constexpr double k = 125e9;
constexpr double onset = 100.0;
constexpr double toughness = 250.0;
constexpr double area = 0.05;
const double peak = std::sqrt(2.0 * k * onset);
const double dc = peak / k * toughness / onset;
const double slope = peak * peak / (2.0 * (toughness - onset));

// K per unit area, shared equally by two slim blocks without lateral contraction, so that both pairs open alike; the
// end moves linearly in time to `end` at time 1.
Scene spring_scene(double spring, double end) {
    Scene scene(2, {area}, {1}, {1.0, 1.0}, {1, 1}, DELAM_QUAD4);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, spring * 2.0, 0.0);
    scene.law(0, {k, k, onset, onset, toughness, toughness});
    scene.hold(scene.find(-1, {0.0, 0.0}, {area, 2.0}), {1.0, 0.0});
    scene.hold(scene.find(0, {0.0, 0.0}, {area, 0.0}), {0.0, 1.0});
    const auto load = scene.pattern("pull", {0.0, 1.0}, {0.0, end});
    const auto top = scene.find(1, {0.0, 2.0}, {area, 2.0});
    scene.drive(top, {0.0, 1.0}, load, std::vector<double>(top.size(), 1.0));
    scene.number("damage_tolerance", 1e-12);
    return scene;
}

double series(double spring) { return 1.0 / spring + 1.0 / k; }
double local_load(double spring) { return peak * series(spring); }
double energetic_load(double spring) { return std::sqrt(2.0 * toughness * series(spring)); }

double largest(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }
double least(const std::vector<double>& values) { return *std::min_element(values.begin(), values.end()); }

// Load at which one step from the unloaded state separates the interface, by `halvings` bisections; every trial is
// rolled back.
double jump_by_halving(Solver& solver, double end, int halvings) {
    double low = 0.0;
    double high = 1.0;
    for (int i = 0; i < halvings; ++i) {
        const double time = 0.5 * (low + high);
        solver.step(time);
        (largest(solver.field("adhesion")) == 0.0 ? high : low) = time;
        solver.rollback();
    }
    return high * end;
}

constexpr double soft[] = {0.5, 0.1, 0.02};  // K over the softening slope

LOOP_TEST(soft_spring_local_jump, 0, 3) {
    const double spring = soft[loop] * slope;
    const double end = 1.3 * local_load(spring);
    Scene scene = spring_scene(spring, end);
    Solver solver(scene, 0.0);
    cases::expect_near(jump_by_halving(solver, end, 16), local_load(spring), 1e-3, local_load(spring), "local jump");
}

LOOP_TEST(soft_spring_energetic_jump, 0, 3) {
    const double spring = soft[loop] * slope;
    const double end = 1.3 * energetic_load(spring);
    cases::expect(energetic_load(spring) < local_load(spring), "the energetic jump comes first");
    Scene scene = spring_scene(spring, end);
    scene.text("solution", "energetic");
    Solver solver(scene, 0.0);
    cases::expect_near(jump_by_halving(solver, end, 16), energetic_load(spring), 1e-3, energetic_load(spring),
                       "energetic jump");
}

// Above the softening slope the solution is unique, and the search must find nothing else.
LOOP_TEST(stiff_spring_energetic_is_continuous, 0, 2) {
    const double spring = slope * (loop == 0 ? 1.5 : 4.0);
    const double end = 1.1 * dc;
    Scene scene = spring_scene(spring, end);
    scene.text("solution", "energetic");
    Solver solver(scene, 0.0);
    const int steps = 33;
    for (int i = 1; i <= steps; ++i) {
        solver.step(static_cast<double>(i) / steps);
        solver.commit();
        const double w = end * i / steps;
        const double exact = w <= local_load(spring) ? w / series(spring)
                             : w >= dc               ? 0.0
                                       : slope * (dc - (w - slope * dc / spring) / (1.0 - slope / spring));
        cases::expect_near(solver.value("reaction:pull"), exact * area, 1e-5, peak * area,
                           "step " + std::to_string(i) + ": force");
    }
    cases::expect_near(solver.value("dissipated"), toughness * area, 1e-9, toughness * area, "the toughness is spent");
}

struct Jump {
    double before = 0.0, time = 0.0, released = 0.0;
};
Jump only_jump(const Solver& solver) {
    const Scene& scene = solver.scene();
    std::int64_t count = 0;
    REQUIRE(scene, delam_solver_jump_count, solver.get(), &count);
    cases::expect(count == 1, "jumps located: " + std::to_string(count));
    Jump jump;
    REQUIRE(scene, delam_solver_jump, solver.get(), 0, nullptr, &jump.before, &jump.time, nullptr, nullptr,
            &jump.released, nullptr, nullptr, nullptr, nullptr);
    return jump;
}

// With the instant located, the ledger has the load of the jump: work is done up to it, w^2/2 (1/K + 1/k)^-1, and none
// after it. What is not dissipated was released: nothing where the two energies cross, sigma0^2/2 (1/K + 1/k) - Gc at
// the local load.
LOOP_TEST(soft_spring_jump_is_located, 0, 6) {
    const bool energetic = loop >= 3;
    const double spring = soft[loop % 3] * slope;
    const double exact = energetic ? energetic_load(spring) : local_load(spring);
    const double end = 1.37 * exact;
    Scene scene = spring_scene(spring, end);
    if (energetic) scene.text("solution", "energetic");
    scene.number("jump_tolerance", 1e-5);
    Solver solver(scene, 0.0);
    const int steps = 5;
    double released = 0.0;
    double jumps = 0.0;
    for (int i = 1; i <= steps; ++i) {
        solver.step(static_cast<double>(i) / steps);
        solver.commit();
        released += solver.value("released");
        jumps += solver.value("jumps");
    }
    cases::expect(largest(solver.field("adhesion")) == 0.0, "no jump");
    const Jump jump = only_jump(solver);
    cases::expect(jumps == 1.0, "one step with a jump");
    cases::expect_near(jump.time * end, exact, 1e-3, exact, "load of the jump");
    cases::expect(jump.before < jump.time && jump.time - jump.before <= 1e-5 / steps * 1.01, "where it was bracketed");
    const double work = solver.value("work") / area;
    cases::expect_near(std::sqrt(2.0 * work * series(spring)), exact, 1e-3, exact,
                       "load of the jump, from the work done");
    cases::expect_near(solver.value("dissipated"), toughness * area, 1e-9, toughness * area, "the toughness is spent");
    const double exact_release = energetic ? 0.0 : (0.5 * exact * exact / series(spring) - toughness) * area;
    cases::expect_near(jump.released, exact_release, 1e-3, toughness * area, "energy released");
    cases::expect_near(released, jump.released, 1e-12, toughness * area, "the step records the same release");
}

// ---- bar bonded to a rigid base ------------------------------------------------------------------------------------

// Energies of all fronts at time 1, including the debonded bar: an exhaustive scan as in reference/fronts.
class BarScan {
public:
    explicit BarScan(const cases::Bar& bar) : bar_(bar), scene_(cases::make_bar(bar)) {
        Solver solver(scene_, 0.0);
        std::vector<double> adhesion = solver.field("adhesion");
        const auto weight = scene_.pairs(0).weight;
        std::size_t next = 0;
        while (adhesion[next] == 0.0) ++next;
        double advance = 0.0;
        while (true) {
            solver.equilibrate(1.0, adhesion);
            stored_.push_back(solver.value("stored_bulk") + solver.value("stored_interface"));
            advance_.push_back(advance);
            solver.rollback();
            if (next == adhesion.size()) return;
            advance += weight[next];
            adhesion[next++] = 0.0;
        }
    }
    // The front of least energy at a time, not behind `from`.
    std::size_t best(double time, std::size_t from) const {
        std::size_t at = from;
        for (std::size_t f = from; f < stored_.size(); ++f)
            if (total(f, time) < total(at, time)) at = f;
        return at;
    }
    double total(std::size_t f, double time) const { return stored_[f] * time * time + bar_.toughness * advance_[f]; }
    double force(std::size_t f, double time) const { return 2.0 * stored_[f] * time / bar_.final_load; }
    double front(std::size_t f) const { return bar_.start + advance_[f]; }
    std::size_t last() const { return stored_.size() - 1; }

private:
    cases::Bar bar_;
    Scene scene_;
    std::vector<double> stored_, advance_;
};

struct Errors {
    double force = 0.0;  // over the plateau
    double front = 0.0;  // m
};

void compare(Errors& errors, const cases::Bar& bar, double w, double force, double front) {
    const double a = std::max(bar.start, bar.front(w));
    errors.front = std::max(errors.front, std::abs(front - a));
    errors.force = std::max(errors.force, std::abs(force - bar.membrane * w / (a + bar.bond_length)) / bar.plateau());
}

cases::Bar bar_of(std::int64_t cells, double end_front, bool held = true) {
    cases::Bar bar;
    bar.cells = cells;
    bar.bond_length = 0.04;
    bar.held = held;
    bar.final_load = bar.load(end_front);
    return bar;
}

constexpr std::int64_t meshes[] = {50, 100, 200};

void expect_first_order(const Errors* errors, const char* what) {
    for (int m = 0; m + 1 < 3; ++m) {
        const double force = std::log2(errors[m].force / errors[m + 1].force);
        const double front = std::log2(errors[m].front / errors[m + 1].front);
        const std::string where = std::string(what) + ", order from mesh " + std::to_string(m) + ": ";
        cases::expect_near(force, 1.0, 0.2, 1.0, where + "force");
        cases::expect_near(front, 1.0, 0.2, 1.0, where + "front");
    }
}

// Least energy of all fronts, 8 loads per cell: the front jumps from pair to pair, so its error never exceeds one cell,
// and the force is a sawtooth around the plateau; both errors are of first order in h.
TEST(bar_scan_follows_the_plateau) {
    Errors errors[3];
    for (int m = 0; m < 3; ++m) {
        const cases::Bar bar = bar_of(meshes[m], 0.7);
        const BarScan scan(bar);
        const auto steps = 8 * meshes[m];
        std::size_t at = 0;
        for (std::int64_t i = 1; i <= steps; ++i) {
            const double time = static_cast<double>(i) / static_cast<double>(steps);
            at = scan.best(time, at);
            compare(errors[m], bar, time * bar.final_load, scan.force(at, time), scan.front(at));
        }
        cases::expect_below(errors[m].front, 1.02 * bar.h(), "front, in cells");
        cases::expect_below(errors[m].force, 2.2 * bar.h() / bar.length, "force over the plateau");
    }
    expect_first_order(errors, "scan");
}

// The same bar by the local analysis: the pair at the tip must reach its strength, which happens late by h over the
// length lam of the bond. First order too, with a larger constant: energetic = local in the limit.
TEST(bar_local_converges_to_the_plateau) {
    Errors errors[3];
    for (int m = 0; m < 3; ++m) {
        const cases::Bar bar = bar_of(2 * meshes[m], 0.6);
        Scene scene = cases::make_bar(bar);
        Solver solver(scene, 0.0);
        const auto steps = 4 * bar.cells;
        for (std::int64_t i = 1; i <= steps; ++i) {
            solver.step(static_cast<double>(i) / static_cast<double>(steps));
            solver.commit();
            compare(errors[m], bar, bar.final_load * static_cast<double>(i) / static_cast<double>(steps),
                    solver.value("reaction:pull"), bar.start + solver.value("front"));
        }
        cases::expect_below(errors[m].force, 0.7 * bar.h() / bar.bond_length, "force over the plateau, h over lam");
        cases::expect_below(errors[m].front, 10.0 * bar.h(), "front, in cells");
    }
    expect_first_order(errors, "local");
}

// The library's search along the plateau: no more energy than the scan after every step.
LOOP_TEST(bar_energetic_follows_the_plateau, 0, 3) {
    const cases::Bar bar = bar_of(meshes[loop], 0.7);
    Scene scene = cases::make_bar(bar);
    scene.text("solution", "energetic");
    const BarScan scan(bar);
    Solver solver(scene, 0.0);
    const int steps = 60;
    Errors errors;
    std::size_t at = 0;
    for (int i = 1; i <= steps; ++i) {
        const double time = static_cast<double>(i) / steps;
        solver.step(time);
        solver.commit();
        at = scan.best(time, at);
        const double energy =
            solver.value("stored_bulk") + solver.value("stored_interface") + solver.value("dissipated");
        cases::expect_below(energy, scan.total(at, time) * (1.0 + 1e-6),
                            "step " + std::to_string(i) + ": energy over the scan's");
        compare(errors, bar, time * bar.final_load, solver.value("reaction:pull"), bar.start + solver.value("front"));
    }
    cases::expect_below(errors.front, 1.02 * bar.h(), "front");
    cases::expect_below(errors.force, 2.2 * bar.h() / bar.length, "force over the plateau");
}

// Free far end, a0 < L/2: full debonding takes as little energy as the front at (a + lam) = (L + lam)/2, and the
// energetic solution jumps to it.
double full_debonding_load(const cases::Bar& bar) {
    return 0.5 * (bar.length + bar.bond_length) * bar.plateau() / bar.membrane;
}

TEST(free_bar_scan_jumps_halfway) {
    double errors[3];
    for (int m = 0; m < 3; ++m) {
        const cases::Bar bar = bar_of(meshes[m], 0.7, false);
        const BarScan scan(bar);
        // The load from which the debonded state has less energy, by bisection.
        double low = 0.0;
        double high = 1.0;
        for (int i = 0; i < 40; ++i) {
            const double time = 0.5 * (low + high);
            (scan.best(time, 0) == scan.last() ? high : low) = time;
        }
        const double exact = full_debonding_load(bar);
        errors[m] = high * bar.final_load / exact - 1.0;
        cases::expect_below(std::abs(errors[m]), 1e-3 + 0.2 * bar.h() / bar.length, "load of the jump");
        cases::expect_near(scan.front(scan.best(low, 0)), exact * bar.membrane / bar.plateau() - bar.bond_length, 1.0,
                           1.02 * bar.h(), "front before it");
    }
    cases::expect_below(std::abs(errors[2]), 1e-3, "load of the jump, finest mesh");
}

TEST(free_bar_energetic_jumps_halfway) {
    const cases::Bar bar = bar_of(cases::whole() ? 200 : 150, 0.7, false);
    Scene scene = cases::make_bar(bar);
    scene.text("solution", "energetic");
    scene.number("jump_tolerance", 1e-5);
    Solver solver(scene, 0.0);
    const int steps = 20;
    double before = 0.0;
    for (int i = 1; i <= steps; ++i) {
        solver.step(static_cast<double>(i) / steps);
        solver.commit();
        if (least(solver.field("adhesion")) == 0.0 && largest(solver.field("adhesion")) == 0.0) break;
        before = solver.value("work");
    }
    cases::expect(largest(solver.field("adhesion")) == 0.0, "the bar never comes off");
    // Along the plateau the work is F (w - w0/2), where w0 is the load at which the front starts: the ledger has the
    // load of the jump.
    const double start = bar.load(bar.start);
    const double load = solver.value("work") / bar.plateau() + 0.5 * start;
    cases::expect(solver.value("work") >= before, "work is done up to the jump");
    cases::expect_near(load, full_debonding_load(bar), 5e-3, full_debonding_load(bar),
                       "load of the jump, from the work done");
    // The pair at the tip has a whole cell to break.
    cases::expect_near(solver.value("dissipated"), bar.toughness * (bar.length - bar.start + 0.5 * bar.h()), 1e-9,
                       bar.toughness * bar.length, "all is dissipated");
}

}  // namespace
