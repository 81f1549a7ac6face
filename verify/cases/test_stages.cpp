// SPDX-License-Identifier: BSD-3-Clause
// Supports that begin or end within an analysis: what begins finds its nodes where they are, what ends leaves its
// force, and nothing else changes there. Closed forms of a bar, and analyses that are the same without such supports.
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "small_analysis.hpp"

namespace {

using reference::Scene;
using reference::Solver;

constexpr const char* ways[] = {"condensed", "feti", "iterated"};
constexpr double tight = 1e-9;

std::int64_t constraints(const Scene& scene) {
    std::int64_t rows = 0;
    REQUIRE(scene, delam_problem_constraints, scene.problem(), &rows, nullptr, nullptr, nullptr, nullptr, nullptr,
            nullptr);
    return rows;
}

std::vector<double> along(int d, int axis) {
    std::vector<double> direction(static_cast<std::size_t>(d), 0.0);
    direction[static_cast<std::size_t>(axis)] = 1.0;
    return direction;
}

// Two blocks of 1 x 1 x 1 (2D: per unit of width) on each other, E = 1, nu = 0, bonded: a bar of stiffness 1/2 that is
// held at the bottom. The top moves as one, along y.
struct Bar {
    explicit Bar(int d, int way, bool loose = false) : scene(make(d)) {
        scene.interface(0, 1);
        scene.begin();
        scene.elastic(-1, 1.0, 0.0);
        loose ? scene.contact(0) : scene.bonded(0);
        const auto bottom = at(0.0);
        for (int k = 0; k < d; ++k) scene.hold(bottom, along(d, k));
        top = at(2.0);
        scene.text("reduction", ways[way]);
        if (way == 1) scene.number("subdomains", 2);
    }
    static Scene make(int d) {
        if (d == 2) return {2, {1.0}, {1}, {1.0, 1.0}, {1, 1}, DELAM_QUAD4};
        return {3, {1.0, 1.0}, {1, 1}, {1.0, 1.0}, {1, 1}, DELAM_HEX8};
    }
    std::vector<std::int64_t> at(double height) const {
        std::vector<std::int64_t> found;
        const int up = scene.dimension() - 1;
        for (std::size_t n = 0; n < scene.node_count(); ++n)
            if (std::abs(scene.coordinate(static_cast<std::int64_t>(n), up) - height) < 1e-9)
                found.push_back(static_cast<std::int64_t>(n));
        return found;
    }
    // A dead force on the top, 1 at factor 1.
    void push(std::int64_t pattern) {
        std::vector<double> force(top.size() * static_cast<std::size_t>(scene.dimension()), 0.0);
        for (std::size_t i = 0; i < top.size(); ++i)
            force[(i + 1) * static_cast<std::size_t>(scene.dimension()) - 1] = 1.0 / static_cast<double>(top.size());
        REQUIRE(scene, delam_problem_add_forces, scene.problem(), pattern, static_cast<std::int64_t>(top.size()),
                top.data(), force.data(), 0);
    }
    // Supports of the top, at zero or driven; returns the first and their number.
    std::pair<std::int64_t, std::int64_t> grip(std::int64_t pattern = -1) {
        const std::int64_t first = constraints(scene);
        const auto up = along(scene.dimension(), scene.dimension() - 1);
        if (pattern < 0)
            scene.hold(top, up);
        else
            scene.drive(top, up, pattern, std::vector<double>(top.size(), 1.0));
        return {first, constraints(scene) - first};
    }
    void begins(std::pair<std::int64_t, std::int64_t> grip, double time, std::int64_t pattern) {
        REQUIRE(scene, delam_problem_begin_constraints, scene.problem(), grip.first, grip.second, time, pattern);
    }
    void ends(std::pair<std::int64_t, std::int64_t> grip, double time, std::int64_t pattern) {
        REQUIRE(scene, delam_problem_end_constraints, scene.problem(), grip.first, grip.second, time, pattern);
    }

    Scene scene;
    std::vector<std::int64_t> top;
};

void go(Solver& solver, double time) {
    solver.step(time);
    solver.commit();
}

double motion(const Solver& solver, const Bar& bar) {
    const auto d = static_cast<std::size_t>(bar.scene.dimension());
    return solver.field("displacement")[static_cast<std::size_t>(bar.top.front()) * d + d - 1];
}

double sum_of(const Solver& solver, std::pair<std::int64_t, std::int64_t> grip) {
    const std::vector<double> reaction = solver.field("reaction");
    double sum = 0.0;
    for (std::int64_t c = grip.first; c < grip.first + grip.second; ++c) sum += reaction[static_cast<std::size_t>(c)];
    return sum;
}

// A force stretches the bar to u = 2; a grip then finds it there. It stays (loop 0), or goes to zero (1), or to 1 (2)
// over the next unit of time, while the force falls to zero in the one after.
LOOP_TEST(gripped_bar, 0, 18) {
    const int d = loop % 2 == 0 ? 2 : 3, way = loop / 2 % 3, where = loop / 6;
    Bar bar(d, way);
    const auto force = bar.scene.pattern("force", {0.0, 1.0, 2.0, 3.0}, {0.0, 1.0, 1.0, 0.0});
    const auto found =
        where == 0 ? bar.scene.pattern("found", {0.0}, {1.0}) : bar.scene.pattern("found", {1.0, 2.0}, {1.0, 0.0});
    bar.push(force);
    const auto grip = bar.grip(where == 2 ? bar.scene.pattern("move", {1.0, 2.0}, {0.0, 1.0}) : -1);
    bar.begins(grip, 1.0, found);
    Solver solver(bar.scene, 0.0);
    go(solver, 0.5);
    go(solver, 1.0);
    cases::expect_near(motion(solver, bar), 2.0, tight, 2.0, "stretched by the force");
    cases::expect_near(sum_of(solver, grip), 0.0, tight, 1.0, "no support yet");
    const double end = where == 0 ? 2.0 : where == 1 ? 0.0 : 1.0;
    for (const double time : {1.25, 2.0}) {
        go(solver, time);
        const double u = 2.0 + (end - 2.0) * (time - 1.0);
        cases::expect_near(motion(solver, bar), u, tight, 2.0, "moved by the grip");
        cases::expect_near(sum_of(solver, grip), 0.5 * u - 1.0, tight, 1.0, "reaction");
        cases::expect_near(solver.value("stored_bulk"), 0.25 * u * u, tight, 1.0, "stored energy");
        cases::expect_near(solver.value("defect"), 0.0, tight, 1.0, "balance");
    }
    go(solver, 3.0);
    cases::expect_near(motion(solver, bar), end, tight, 2.0, "held without the force");
    cases::expect_near(sum_of(solver, grip), 0.5 * end, tight, 1.0, "reaction without the force");
    cases::expect_near(solver.value("defect"), 0.0, tight, 1.0, "balance in the end");
}

// A grip pulls the bar to u = 2 and ends: its force, 1, falls to zero. It then begins again, as another support.
LOOP_TEST(released_bar, 0, 6) {
    const int d = loop % 2 == 0 ? 2 : 3, way = loop / 2;
    Bar bar(d, way);
    const auto grip = bar.grip(bar.scene.pattern("pull", {0.0, 1.0}, {0.0, 2.0}));
    bar.ends(grip, 1.0, bar.scene.pattern("left", {1.0, 2.0}, {1.0, 0.0}));
    const auto again = bar.grip(bar.scene.pattern("push", {1.5, 3.0}, {0.0, -1.0}));
    bar.begins(again, 1.5, bar.scene.pattern("found", {0.0}, {1.0}));
    Solver solver(bar.scene, 0.0);
    go(solver, 0.5);
    go(solver, 1.0);
    cases::expect_near(sum_of(solver, grip), 1.0, tight, 1.0, "pulled");
    cases::expect_near(solver.value("reaction:pull"), 1.0, tight, 1.0, "reaction of the pattern");
    for (const double time : {1.25, 1.5}) {
        go(solver, time);
        const double share = 2.0 - time;
        cases::expect_near(motion(solver, bar), 2.0 * share, tight, 2.0, "let go");
        cases::expect_near(solver.value("stored_bulk"), share * share, tight, 1.0, "stored energy");
        cases::expect_near(sum_of(solver, grip), 0.0, tight, 1.0, "no support any more");
        cases::expect_near(solver.value("defect"), 0.0, tight, 1.0, "balance");
        // Nothing dissipates: the work is what is stored, and the potential -f.u of what is left of the force.
        cases::expect_near(solver.value("work"), share * share - 2.0 * share * share, tight, 1.0, "work");
    }
    go(solver, 3.0);
    cases::expect_near(motion(solver, bar), 0.0, tight, 2.0, "pushed back from where it was");
    cases::expect_near(sum_of(solver, again), 0.0, tight, 1.0, "reaction");
    cases::expect_near(solver.value("defect"), 0.0, tight, 1.0, "balance in the end");
}

// The upper block, which only touches the lower one, is lifted and turned by its supports. Once these have ended it is
// free, and stays where it is until another support takes it there.
LOOP_TEST(free_part_keeps_its_place, 0, 6) {
    const int d = loop % 2 == 0 ? 2 : 3, way = loop / 2;
    Bar bar(d, way, true);
    const auto lift = bar.scene.pattern("lift", {0.0, 1.0}, {0.0, 0.3}), left = bar.scene.pattern("left", {0.0}, {1.0});
    const std::int64_t first = constraints(bar.scene);
    for (int k = 0; k < d; ++k) {
        std::vector<double> share;
        for (const auto n : bar.top) share.push_back(k == d - 1 ? 1.0 + 0.2 * bar.scene.coordinate(n, 0) : 0.0);
        bar.scene.drive(bar.top, along(d, k), lift, share);
    }
    bar.ends({first, constraints(bar.scene) - first}, 1.0, left);
    const std::vector<std::int64_t> corner{bar.top.front()};
    const std::int64_t later = constraints(bar.scene);
    bar.scene.drive(corner, along(d, d - 1), bar.scene.pattern("again", {2.0, 3.0}, {0.0, 0.1}), {1.0});
    bar.begins({later, 1}, 2.0, bar.scene.pattern("found", {0.0}, {1.0}));
    Solver solver(bar.scene, 0.0);
    go(solver, 1.0);
    const std::vector<double> lifted = solver.field("displacement");
    for (const double time : {1.5, 2.0, 3.0}) {
        go(solver, time);
        const std::vector<double> now = solver.field("displacement");
        for (const auto n : bar.top)
            for (int k = 0; k < d; ++k) {
                const auto i = static_cast<std::size_t>(n * d + k);
                if (time < 3.0) cases::expect_near(now[i], lifted[i], 1e-7, 0.3, "a free part stays");
            }
        if (time == 3.0) cases::expect_near(motion(solver, bar), 0.4, 1e-7, 0.3, "and is taken from there");
        cases::expect_near(solver.value("stored_bulk"), 0.0, 1e-9, 1.0, "without energy");
    }
}

// A double cantilever that is opened by 1.2 mm at its end. `held`: a node of the upper arm that a support may take.
struct Cantilevers {
    explicit Cantilevers(int d, int way) : scene(make(d)) {
        scene.interface(0, 1);
        scene.begin();
        scene.elastic(-1, 70e9, 0.3);
        scene.law(0, {1e12, 1e12, 40.0, 40.0, 200.0, 200.0});
        const auto pairs = scene.pairs(0);
        std::vector<std::int64_t> notch;
        for (std::size_t p = 0; p < pairs.count(); ++p)
            if (scene.coordinate(pairs.node_a[p], 0) < 0.0099) notch.push_back(static_cast<std::int64_t>(p));
        scene.adhesion(0, notch, std::vector<double>(notch.size(), 0.0));
        std::vector<std::int64_t> clamped, low, high;
        for (std::size_t n = 0; n < scene.node_count(); ++n) {
            const auto node = static_cast<std::int64_t>(n);
            const double x = scene.coordinate(node, 0), z = scene.coordinate(node, d - 1);
            if (x > 0.0399) clamped.push_back(node);
            if (x < 1e-6 && z < 1e-6) low.push_back(node);
            if (x < 1e-6 && z > 0.00299) high.push_back(node);
            if (std::abs(x - 0.005) < 1e-6 && z > 0.00299) held.push_back(node);
        }
        for (int k = 0; k < d; ++k) scene.hold(clamped, along(d, k));
        scene.hold(low, along(d, d - 1));
        scene.drive(high, along(d, d - 1), scene.pattern("open", {0.0, 2.0}, {0.0, 1.2e-3}),
                    std::vector<double>(high.size(), 1.0));
        scene.text("reduction", ways[way]);
        if (way == 1) scene.number("subdomains", 2);
    }
    static Scene make(int d) {
        if (d == 2) return {2, {0.04}, {40}, {1.5e-3, 1.5e-3}, {1, 1}, DELAM_QUAD4};
        return {3, {0.04, 0.004}, {40, 2}, {1.5e-3, 1.5e-3}, {1, 1}, DELAM_HEX8};
    }
    // Supports of these nodes that begin at time 1 and follow histories of their own.
    void hold(const std::vector<std::vector<double>>& times_and_values, bool fades) {
        for (std::size_t i = 0; i < held.size(); ++i) {
            const std::int64_t first = constraints(scene);
            const auto pattern =
                scene.pattern(("own-" + std::to_string(i)).c_str(), times_and_values[0], times_and_values[i + 1]);
            scene.drive({held[i]}, along(scene.dimension(), scene.dimension() - 1), pattern, {1.0});
            const auto found =
                scene.pattern(("found-" + std::to_string(i)).c_str(), {1.0, 2.0}, {1.0, fades ? 0.0 : 1.0});
            REQUIRE(scene, delam_problem_begin_constraints, scene.problem(), first, 1, 1.0, found);
        }
    }
    Scene scene;
    std::vector<std::int64_t> held;
};

const std::vector<double>& instants() {
    static const std::vector<double> times{0.25, 0.5, 0.75, 1.0, 1.125, 1.25, 1.5, 1.75, 2.0};
    return times;
}

// A support that moves its nodes by exactly what they do without it changes nothing.
LOOP_TEST(support_that_does_nothing, 0, 14) {
    const int d = loop % 2 == 0 || loop > 11 ? 2 : 3, way = loop > 11 ? 0 : loop / 2 % 3;
    const bool counts_from_there = loop / 6 == 1;
    // Steps that follow their load record the work of loads in proportion otherwise than that of others.
    const auto choose = [&](const Scene& scene) {
        REQUIRE(scene, delam_problem_set_text, scene.problem(), "step_control", "fixed");
        REQUIRE(scene, delam_problem_set_text, scene.problem(), "mixity_rule", "frozen");
        if (loop == 12) REQUIRE(scene, delam_problem_set_text, scene.problem(), "kinematics", "corotational");
        if (loop == 13) REQUIRE(scene, delam_problem_set_text, scene.problem(), "solution", "energetic");
    };
    Cantilevers free(d, way);
    choose(free.scene);
    Solver alone(free.scene, 0.0);
    std::vector<std::vector<double>> own(free.held.size() + 1);
    std::vector<double> before(free.held.size(), 0.0);
    for (const double time : instants()) {
        go(alone, time);
        if (time < 1.0) continue;
        own[0].push_back(time);
        const std::vector<double> moved = alone.field("displacement");
        for (std::size_t i = 0; i < free.held.size(); ++i) {
            const double u = moved[static_cast<std::size_t>(free.held[i] * d + d - 1)];
            if (time == 1.0 && counts_from_there) before[i] = u;
            own[i + 1].push_back(u - before[i]);
        }
    }
    const double width = d == 2 ? 1.0 : 0.004;
    cases::expect(alone.value("debonded_length") > 0.002 * width, "the crack grows, or nothing was tested");
    Cantilevers gripped(d, way);
    gripped.hold(own, !counts_from_there);
    choose(gripped.scene);
    Solver solver(gripped.scene, 0.0);
    for (const double time : instants()) go(solver, time);
    const double scale = alone.value("work");
    // Steps with large rotations end where another linear step would move the bodies by 1e-6.
    const double known = loop == 12 ? 1e-5 : 1e-6;
    for (const char* key : {"stored_bulk", "stored_interface", "dissipated", "work", "released", "defect"})
        cases::expect_near(solver.value(key), alone.value(key), known, scale, key);
    cases::expect_near(solver.value("reaction:open"), alone.value("reaction:open"), 1e-5, alone.value("reaction:open"),
                       "reaction");
}

// The energies at a change are those before it, and the balance goes on.
LOOP_TEST(energies_across_a_change, 0, 6) {
    const int d = loop % 2 == 0 ? 2 : 3, way = loop / 2;
    Cantilevers arms(d, way);
    arms.hold({{0.0}, {0.0}, {0.0}, {0.0}}, true);
    Solver solver(arms.scene, 0.0);
    for (const double time : {0.25, 0.5, 0.75, 1.0}) go(solver, time);
    const double scale = solver.value("work"), stored = solver.value("stored_bulk");
    const double springs = solver.value("stored_interface"), lost = solver.value("dissipated");
    const double before = solver.value("defect");
    const std::vector<double> jump = solver.field("jump");
    solver.step(1.125);
    arms.scene.require(delam_solver_look(solver.get(), 4), "delam_solver_look");
    cases::expect_near(solver.value("time"), 1.0, 0.0, 1.0, "the state at the change");
    cases::expect_near(solver.value("stored_bulk"), stored, 1e-7, scale, "stored in the bodies");
    cases::expect_near(solver.value("stored_interface"), springs, 1e-7, scale, "stored in the interface");
    cases::expect_near(solver.value("dissipated"), lost, 0.0, scale, "dissipated");
    cases::expect_near(solver.value("work"), scale, 0.0, scale, "work");
    cases::expect_near(solver.value("defect"), before, 1e-7, scale, "balance");
    const std::vector<double> after = solver.field("jump");
    for (std::size_t i = 0; i < jump.size(); ++i) cases::expect_near(after[i], jump[i], 1e-6, 1.2e-3, "jumps");
    cases::expect_near(sum_of(solver, {constraints(arms.scene) - 1, 1}), 0.0, 1e-6, solver.value("reaction:open"),
                       "a support that begins has no force");
}

// A step into another stage can be refused; states of any stage are saved, and loaded by a solver in any other.
LOOP_TEST(states_of_stages, 0, 6) {
    const int d = loop % 2 == 0 ? 2 : 3, way = loop / 2;
    Cantilevers arms(d, way);
    arms.hold({{1.0, 2.0}, {0.0, 1e-4}, {0.0, 1e-4}, {0.0, 1e-4}}, false);
    Solver solver(arms.scene, 0.0);
    for (const double time : {0.25, 0.5, 0.75, 1.0}) go(solver, time);
    const auto at_change = solver.save();
    const auto there = cases::read_bits(solver);
    solver.step(1.125);
    const auto first = cases::read_bits(solver);
    solver.rollback();
    cases::expect_same(solver, cases::read_bits(solver), there, "rolled back");
    cases::expect(solver.save() == at_change, "the state that was rolled back to");
    solver.step(1.5);
    solver.rollback();
    solver.step(1.125);
    cases::expect_same(solver, cases::read_bits(solver), first, "the step again");
    solver.commit();
    go(solver, 1.5);
    const auto later = solver.save();
    const auto in_second = cases::read_bits(solver);
    go(solver, 2.0);
    const auto in_the_end = cases::read_bits(solver);

    Solver other(arms.scene, 0.0);
    arms.scene.require(other.load(later), "delam_solver_load");
    cases::expect_same(other, cases::read_bits(other), in_second, "a state of the second stage, loaded in the first");
    cases::expect(other.save() == later, "saved again");
    go(other, 2.0);
    cases::expect_same(other, cases::read_bits(other), in_the_end, "and continued");
    arms.scene.require(other.load(at_change), "delam_solver_load");
    cases::expect_same(other, cases::read_bits(other), there, "a state of the first stage, loaded in the second");
    other.step(1.125);
    cases::expect_same(other, cases::read_bits(other), first, "and continued over the change");
}

void expect_told(const Scene& scene, std::int32_t status, std::int32_t expected, const char* words) {
    const std::string message = delam_context_message(scene.context());
    cases::expect(status == expected, std::string(delam_status_name(status)) + " for " + words);
    cases::expect(message.find(words) != std::string::npos, message + " lacks: " + words);
}

TEST(refusals) {
    Bar bar(2, 0);
    Scene& scene = bar.scene;
    bar.push(scene.pattern("force", {0.0, 1.0}, {0.0, 1.0}));
    const auto grip = bar.grip();
    delam_problem* problem = scene.problem();
    const auto fades = scene.pattern("fades", {1.0, 2.0}, {1.0, 0.0}), left = scene.pattern("left", {0.0}, {1.0});
    const auto begin = [&](std::int64_t first, std::int64_t count, double time, std::int64_t pattern) {
        return delam_problem_begin_constraints(problem, first, count, time, pattern);
    };
    expect_told(scene, begin(grip.first, grip.second + 1, 1.0, fades), DELAM_ERROR_ARGUMENT, "first");
    expect_told(scene, begin(grip.first, 0, 1.0, fades), DELAM_ERROR_ARGUMENT, "count");
    expect_told(scene, begin(grip.first, grip.second, 2.0, fades), DELAM_ERROR_ARGUMENT, "factor 0 at time 2");
    expect_told(scene, begin(grip.first, grip.second, 1.0, 0), DELAM_ERROR_PROBLEM, "drives forces already");
    bar.begins(grip, 0.7, fades);  // replaced by the next call
    bar.begins(grip, 1.0, fades);
    expect_told(scene, delam_problem_end_constraints(problem, grip.first, grip.second, 1.0, left), DELAM_ERROR_PROBLEM,
                "must end later");
    bar.ends(grip, 2.5, left);
    Solver solver(scene, 0.0);
    expect_told(scene, solver.advance(1.5), DELAM_ERROR_ARGUMENT, "time 1, at which supports begin or end");
    go(solver, 1.0);
    expect_told(scene, solver.advance(3.0), DELAM_ERROR_ARGUMENT, "time 2.5, at which supports begin or end");
    go(solver, 2.5);
    go(solver, 3.0);
}

// Steps before a change are not kept for backtracking once the first step behind it is committed.
TEST(no_return_over_a_change) {
    Cantilevers arms(2, 0);
    arms.hold({{0.0}, {0.0}}, true);
    arms.scene.text("backtracking", "on");
    Solver solver(arms.scene, 0.0);
    for (const double time : {0.5, 0.75, 1.0}) go(solver, time);
    arms.scene.require(delam_solver_look(solver.get(), 2), "delam_solver_look");
    go(solver, 1.125);
    expect_told(arms.scene, delam_solver_look(solver.get(), 2), DELAM_ERROR_ARGUMENT, "step 2 is not kept");
    arms.scene.require(delam_solver_look(solver.get(), 3), "delam_solver_look");
}

// A stage whose supports leave a motion free is told with its time, before anything is computed.
TEST(stage_that_nothing_holds) {
    Bar bar(2, 0);
    bar.grip();
    const auto left = bar.scene.pattern("left", {1.0, 2.0}, {1.0, 0.0});
    bar.ends({0, constraints(bar.scene)}, 1.0, left);
    expect_told(bar.scene, delam_problem_check(bar.scene.problem()), DELAM_ERROR_PROBLEM,
                "from time 1 on, where supports begin or end: missing support");
    delam_solver* solver = nullptr;
    expect_told(bar.scene, delam_solver_create(bar.scene.problem(), 0.0, &solver), DELAM_ERROR_PROBLEM,
                "from time 1 on");
}

// Two supports of one node whose times overlap are told by their numbers.
TEST(overlapping_supports) {
    Bar bar(2, 0);
    const auto left = bar.scene.pattern("left", {1.0, 2.0}, {1.0, 0.0});
    bar.ends(bar.grip(), 1.0, left);
    bar.grip();
    expect_told(bar.scene, delam_problem_check(bar.scene.problem()), DELAM_ERROR_PROBLEM, "constraint 6");
}

}  // namespace
