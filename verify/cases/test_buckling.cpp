// SPDX-License-Identifier: BSD-3-Clause
// Bodies that buckle under their stresses: a strut between clamps against the elastica, a film on a base against the
// theory of blisters, in few and many steps, turned, and in other units; and faces that keep a film flat.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "condensed_scenes.hpp"
#include "small_analysis.hpp"
#include "support.hpp"

namespace {

using reference::LawData;
using reference::Scene;
using reference::Solver;

constexpr double pi = 3.141592653589793;
using Place = std::array<double, 3>;

// Tells where a scene lies and in which unit: a quarter of a turn takes one state of a symmetric pair to the other.
struct View {
    double angle = 0.0, unit = 1.0;  // unit: of length; that of force stays
    Place at(const Place& x) const {
        const double c = std::cos(angle), s = std::sin(angle);
        return {unit * (c * x[0] - s * x[1]), unit * (s * x[0] + c * x[1]), 0.0};
    }
    std::vector<double> along(std::size_t axis, double sign = 1.0) const {
        Place e{};
        e[axis] = sign / unit;
        const Place t = at(e);
        return {t[0], t[1]};
    }
    std::vector<std::int64_t> nodes(const Scene& scene, std::int32_t body, std::size_t axis, double value) const {
        const std::vector<double> e = along(axis);
        return cases::nodes_where(scene, body, [&](const double* x) {
            return std::abs(x[0] * e[0] + x[1] * e[1] - unit * value) < 1e-6 * unit;
        });
    }
};

void hold(Scene& scene, const std::vector<std::int64_t>& nodes, const std::vector<double>& direction) {
    scene.hold(nodes, direction);
}

void drive(Scene& scene, const std::vector<std::int64_t>& nodes, const std::vector<double>& direction,
           std::int64_t pattern) {
    scene.drive(nodes, direction, pattern, std::vector<double>(nodes.size(), 1.0));
}

struct Step {
    double time, reaction, stored, work, released, modes, buckled;
};

std::vector<Step> run(Solver& solver, int steps) {
    std::vector<Step> all;
    for (int k = 1; k <= steps; ++k) {
        solver.step(static_cast<double>(k) / steps);
        solver.commit();
        all.push_back({solver.value("time"), solver.value("reaction:load"),
                       solver.value("stored_bulk") + solver.value("stored_interface"), solver.value("work"),
                       solver.value("released"), solver.value("buckling_modes"), solver.value("buckling_time")});
    }
    return all;
}

// Per unit of width: between clamps, shortened.
struct Strut {
    double length = 20.0, height = 0.5, young = 1000.0;
    double critical() const { return pi * pi * height * height / (3.0 * length); }  // shortening
    double inertia() const { return height * height * height / 12.0; }

    Scene scene(double shortening, const View& view = {}, const char* kinematics = "corotational") const {
        Scene scene = cases::make_blocks(2, {{{0.0, 0.0, 0.0}, {length, height, 0.0}, {40, 2, 1}}},
                                         [&](const Place& x) { return view.at(x); });
        scene.begin();
        scene.elastic(-1, young / (view.unit * view.unit), 0.0);
        scene.text("kinematics", kinematics);
        const auto load = scene.pattern("load", {0.0, 1.0}, {0.0, view.unit * shortening});
        for (std::size_t k = 0; k < 2; ++k) hold(scene, view.nodes(scene, 0, 0, 0.0), view.along(k));
        hold(scene, view.nodes(scene, 0, 0, length), view.along(1));
        drive(scene, view.nodes(scene, 0, 0, length), view.along(0, -1.0), load);
        return scene;
    }
    // The rise, force and largest slope of an elastica between clamps at a shortening: four cantilevers of the modulus
    // k, P = 16 K^2 E I / L^2, rise L k / K, and 2 L (1 - E/K) of the shortening is bending (S. Timoshenko, J. Gere,
    // Theory of Elastic Stability, section 2.7).
    struct Elastica {
        double force, rise, slope;
    };
    Elastica elastica(double shortening) const {
        double low = 0.0, high = 0.9;
        Elastica found{};
        for (int n = 0; n < 100; ++n) {
            const double k = 0.5 * (low + high), first = std::comp_ellint_1(k), second = std::comp_ellint_2(k);
            found.force = 16.0 * first * first * young * inertia() / (length * length);
            found.rise = length * k / first;
            found.slope = 2.0 * std::asin(k);
            const double strain = found.force / (young * height);
            (2.0 * length * (1.0 - second / first) + strain * length > shortening ? high : low) = k;
        }
        return found;
    }
};

// A film on a base that is shortened with it, bonded but for 15 mm to either side of its middle. N and mm.
struct Blister {
    double half = 15.0, bonded = 12.0, height = 0.5, base = 2.0, young = 70e3, poisson = 0.3, toughness = 0.2,
           onset = 3e-4;
    double critical() const { return pi * pi / 12.0 * height * height / (half * half); }  // strain
    double modulus() const { return young / (1.0 - poisson * poisson); }
    // The energy release rate at a strain (J. Hutchinson, Z. Suo, Adv. Appl. Mech. 29, 1992, equation 6.8).
    double rate(double strain) const {
        return 0.5 * modulus() * height * (strain - critical()) * (strain + 3.0 * critical());
    }
    double growth() const {  // the strain at which it is the toughness
        double low = critical(), high = 10.0 * critical();
        for (int n = 0; n < 100; ++n) (rate(0.5 * (low + high)) < toughness ? low : high) = 0.5 * (low + high);
        return low;
    }
    double rise(double strain) const { return 4.0 * half / pi * std::sqrt(strain - critical()); }

    // below: the film is under the base; covered: another base lies on it.
    Scene scene(double strain, bool below = false, bool covered = false,
                const char* kinematics = "corotational") const {
        const double length = 2.0 * (half + bonded), top = base + height;
        const int cells = static_cast<int>(std::lround(length / 0.25));
        std::vector<cases::Block> blocks{{{0.0, 0.0, 0.0}, {length, base, 0.0}, {cells, 1, 1}},
                                         {{0.0, base, 0.0}, {length, top, 0.0}, {cells, 1, 1}}};
        if (covered) blocks.push_back({{0.0, top, 0.0}, {length, top + base, 0.0}, {cells, 1, 1}});
        Scene scene = cases::make_blocks(2, blocks, [&](const Place& x) -> Place {
            if (below) return {length - x[0], -x[1], 0.0};
            return x;
        });
        const std::int32_t bodies = covered ? 3 : 2;
        for (std::int32_t i = 0; i + 1 < bodies; ++i) scene.interface(i, i + 1);
        scene.begin();
        scene.elastic(-1, 20.0 * young, poisson);
        scene.elastic(1, young, poisson);
        for (std::int32_t i = 0; i + 1 < bodies; ++i) {
            scene.law(i, {1e6, 1e6, onset, onset, toughness, toughness, 1.0});
            std::vector<std::int64_t> open;
            const auto pairs = scene.pairs(i);
            for (std::size_t p = 0; p < pairs.count(); ++p)
                if (std::abs(scene.coordinate(pairs.node_b[p], 0) - 0.5 * length) < half - 1e-6)
                    open.push_back(static_cast<std::int64_t>(p));
            scene.adhesion(i, open, std::vector<double>(open.size(), 0.0));
        }
        scene.text("kinematics", kinematics);
        const auto load = scene.pattern("load", {0.0, 1.0}, {0.0, strain * length});
        const double turn = below ? -1.0 : 1.0, begin = below ? length : 0.0;
        for (std::int32_t body = 0; body < bodies; ++body) {
            const auto end = [&](double x) {
                return cases::nodes_where(scene, body, [x](const double* p) { return std::abs(p[0] - x) < 1e-6; });
            };
            hold(scene, end(begin), {1.0, 0.0});
            drive(scene, end(length - begin), {-turn, 0.0}, load);
        }
        hold(scene, cases::nodes_where(scene, 0, [](const double* p) { return std::abs(p[1]) < 1e-9; }), {0.0, 1.0});
        return scene;
    }
};

double opening(const Solver& solver) {
    double most = 0.0;
    const std::vector<double> jump = solver.field("jump");
    for (std::size_t i = 0; i < jump.size(); i += 2) most = std::max(most, jump[i]);
    return most;
}

}  // namespace

// The strut has no imperfection.
TEST(strut_buckles_like_an_elastica) {
    const Strut strut;
    const double last = 4.0 * strut.critical();
    std::vector<std::vector<Step>> analyses;
    for (const int steps : {15, 60}) {
        const Scene scene = strut.scene(last);
        Solver solver(scene, 0.0);
        analyses.push_back(run(solver, steps));
        int buckled = 0;
        for (const Step& step : analyses.back()) {
            cases::expect_near(step.stored + step.released, step.work, 1e-3, step.work, "balance");
            cases::expect(step.released == 0.0, "nothing snaps through");
            if (step.modes == 0.0) continue;
            ++buckled;
            cases::expect(step.modes == 1.0, "one mode");
            cases::expect_near(step.buckled * last, strut.critical(), 1e-2, strut.critical(), "critical shortening");
        }
        cases::expect(buckled == 1, "it buckles once");
        const auto [force, rise, slope] = strut.elastica(last);
        cases::expect_near(analyses.back().back().reaction, force, 1e-2, force, "force");
        double most = 0.0;
        for (const double u : solver.field("displacement")) most = std::max(most, std::abs(u));
        cases::expect_near(most, rise, 1e-2, rise, "rise");
        cases::expect_near(solver.value("rotation_max"), slope, 1e-2, slope, "slope");
    }
    for (std::size_t k = 0; k < 15; ++k) {
        const Step &few = analyses[0][k], &many = analyses[1][4 * k + 3];
        cases::expect_near(few.reaction, many.reaction, 1e-5, many.reaction, "force in 15 and 60 steps");
        cases::expect_near(few.work, many.work, 1e-3, many.work, "work in 15 and 60 steps");
    }
}

// The same strut, 2 mm wide, on both realisations of the jump operator.
LOOP_TEST(strut_in_space_buckles, 0, 2) {
    const Strut strut;
    constexpr double width = 2.0;
    Scene scene = cases::make_blocks(3, {{{0.0, 0.0, 0.0}, {strut.length, strut.height, width}, {40, 2, 1}}}, nullptr);
    scene.begin();
    scene.elastic(-1, strut.young, 0.0);
    scene.text("kinematics", "corotational");
    scene.text("reduction", loop == 0 ? "condensed" : "iterated");
    const double last = 2.0 * strut.critical();
    const auto load = scene.pattern("load", {0.0, 1.0}, {0.0, last});
    const auto end = [&](double x) {
        return cases::nodes_where(scene, 0, [x](const double* p) { return std::abs(p[0] - x) < 1e-6; });
    };
    for (int k = 0; k < 3; ++k) {
        hold(scene, end(0.0), cases::unit(3, k));
        if (k > 0) hold(scene, end(strut.length), cases::unit(3, k));
    }
    drive(scene, end(strut.length), cases::unit(3, 0, -1.0), load);
    Solver solver(scene, 0.0);
    double modes = 0.0, buckled = 0.0;
    for (const Step& step : run(solver, 6)) {
        modes += step.modes;
        buckled += step.buckled * last;
        cases::expect_near(step.stored, step.work, 1e-3, step.work, "balance");
    }
    cases::expect(modes == 1.0, "it buckles once");
    cases::expect_near(buckled, strut.critical(), 1e-2, strut.critical(), "critical shortening");
    const double force = width * strut.elastica(last).force;
    cases::expect_near(solver.value("reaction:load"), force, 1e-2, force, "force");
}

// A quarter of a turn, the mirror image, and another unit of length.
TEST(branches_are_invariant) {
    const Strut strut;
    const auto numbers = [&](const View& view) {
        const Scene scene = strut.scene(2.0 * strut.critical(), view);
        Solver solver(scene, 0.0);
        std::vector<double> all;
        for (const Step& step : run(solver, 6))
            for (const double x : {step.reaction * view.unit, step.stored, step.work, step.buckled}) all.push_back(x);
        return all;
    };
    const std::vector<double> plain = numbers({});
    for (const View& view : {View{0.5 * pi, 1.0}, View{pi, 1.0}, View{0.3, 1.0}, View{0.0, 1e-3}, View{0.0, 25.4}}) {
        const std::vector<double> other = numbers(view);
        for (std::size_t i = 0; i < plain.size(); ++i)
            cases::expect_near(other[i], plain[i], 1e-6, std::abs(plain[i]), "number " + std::to_string(i));
    }
}

// What cannot come off rises like a film between clamps, also where nobody has said that rotations are large.
LOOP_TEST(blister_rises, 0, 2) {
    Blister blister;
    blister.onset = blister.toughness = 1e6;
    const Scene scene = blister.scene(3.0 * blister.critical(), false, false, loop == 0 ? "corotational" : "auto");
    Solver solver(scene, 0.0);
    for (int k = 1; k <= 6; ++k) {
        solver.step(k / 6.0);
        solver.commit();
        const double strain = 0.5 * k * blister.critical();
        if (k > 2) cases::expect_near(opening(solver), blister.rise(strain), 4e-2, blister.rise(strain), "rise");
    }
    cases::expect(solver.value("dissipated") == 0.0, "nothing comes off");
}

// It must not stay flat, and grows where the theory of thin films says, which knows no compliance of its root.
TEST(blister_buckles_and_grows) {
    const Blister blister;
    const double last = 1.03 * blister.growth();
    std::vector<double> ends;
    for (const bool below : {false, true}) {
        const Scene scene = blister.scene(last, below);
        Solver solver(scene, 0.0);
        for (int k = 1; k <= 20; ++k) {
            solver.step(k / 20.0);
            solver.commit();
            const double strain = k / 20.0 * last, work = solver.value("work");
            const double stored = solver.value("stored_bulk") + solver.value("stored_interface");
            cases::expect_near(stored + solver.value("dissipated") + solver.value("released"), work, 1e-3, work,
                               "balance");
            if (solver.value("buckling_modes") > 0.0)
                cases::expect_near(solver.value("buckling_time") * last, blister.critical(), 3e-2, blister.critical(),
                                   "critical strain");
            if (strain < 0.95 * blister.critical()) cases::expect_below(opening(solver), 1e-6, "flat");
            if (strain < 0.97 * blister.growth())
                cases::expect(solver.value("debonded_length") == 0.0, "no growth before its strain");
        }
        cases::expect_below(0.5, solver.value("debonded_length"), "growth beyond its strain, mm");
        for (const char* key : {"reaction:load", "dissipated", "debonded_length", "work"})
            ends.push_back(solver.value(key));
    }
    for (std::size_t i = 0; i < 4; ++i)
        cases::expect_near(ends[i + 4], ends[i], 1e-5, std::abs(ends[i]), "mirror image, number " + std::to_string(i));
}

// Between two bases it can open nowhere: the faces hold it without a force.
TEST(faces_hold_a_film) {
    const Blister blister;
    const Scene scene = blister.scene(2.0 * blister.critical(), false, true);
    Solver solver(scene, 0.0);
    for (int k = 1; k <= 6; ++k) {
        solver.step(k / 6.0);
        solver.commit();
        cases::expect(solver.value("buckling_modes") == 0.0, "no mode is followed");
        cases::expect_below(opening(solver), 1e-6, "opening");
        for (const double j : solver.field("jump")) cases::expect_below(std::abs(j), 1e-6, "jump");
        cases::expect_near(solver.value("stored_bulk"), solver.value("work"), 1e-6, solver.value("work"), "work");
    }
}

// A state that is saved on the way goes on bit by bit, with what it tells of its step.
TEST(saved_branches_go_on) {
    const Strut strut;
    const Scene scene = strut.scene(3.0 * strut.critical()), again = strut.scene(3.0 * strut.critical());
    Solver whole(scene, 0.0), resumed(again, 0.0);
    const auto walk = [](Solver& solver, int first, int last) {
        for (int k = first; k <= last; ++k) {
            solver.step(k / 8.0);
            solver.commit();
        }
    };
    walk(whole, 1, 3);
    cases::expect(whole.value("buckling_modes") == 1.0, "the third step buckles");
    const auto bytes = whole.save();
    const auto then = cases::read_bits(whole);
    walk(whole, 4, 8);
    again.require(resumed.load(bytes), "delam_solver_load");
    cases::expect_same(resumed, cases::read_bits(resumed), then, "after loading");
    walk(resumed, 4, 8);
    cases::expect_same(resumed, cases::read_bits(resumed), cases::read_bits(whole), "in the end");
}

// Small rotations keep bodies flat, but tell by how much the stresses exceed the critical ones: those of Euler's strut,
// at which rotations of any size find the branch, in any view and unit, and in proportion to the load.
TEST(small_rotations_tell_of_buckling) {
    const Strut strut;
    const double last = 2.0 * strut.critical();
    const Scene branch = strut.scene(last);
    Solver turned(branch, 0.0);
    double buckled = 0.0;
    for (const Step& step : run(turned, 6)) buckled += step.buckled;
    cases::expect(std::isnan(turned.value("buckling_ratio")), "rotations of any size have no ratio");
    cases::expect(turned.value("rotation_error") == 0.0, "rotations of any size have no error");
    for (const View& view : {View{}, View{0.3, 1.0}, View{0.5 * pi, 25.4}}) {
        const Scene scene = strut.scene(last, view, "linear");
        Solver solver(scene, 0.0);
        for (const double time : {0.5, 1.0}) {
            solver.step(time);
            solver.commit();
            const double ratio = solver.value("buckling_ratio");
            cases::expect_near(ratio * strut.critical(), time * last, 1e-2, time * last, "against Euler");
            cases::expect_near(ratio * buckled, time, 1e-2, time, "against the branch");
        }
    }
    const Scene pulled = strut.scene(-last, {}, "linear");
    Solver solver(pulled, 0.0);
    solver.step(1.0);
    cases::expect_below(solver.value("buckling_ratio"), 0.05, "a strut that is pulled");
}

// The strut in space, with every realisation of the jump operator.
LOOP_TEST(small_rotations_tell_of_buckling_in_space, 0, 3) {
    const Strut strut;
    constexpr const char* reductions[] = {"condensed", "iterated", "feti"};
    Scene scene = cases::make_blocks(3, {{{0.0, 0.0, 0.0}, {strut.length, strut.height, 2.0}, {40, 2, 1}}}, nullptr);
    scene.begin();
    scene.elastic(-1, strut.young, 0.0);
    scene.text("reduction", reductions[loop]);
    const auto load = scene.pattern("load", {0.0, 1.0}, {0.0, 2.0 * strut.critical()});
    const auto end = [&](double x) {
        return cases::nodes_where(scene, 0, [x](const double* p) { return std::abs(p[0] - x) < 1e-6; });
    };
    for (int k = 0; k < 3; ++k) {
        hold(scene, end(0.0), cases::unit(3, k));
        if (k > 0) hold(scene, end(strut.length), cases::unit(3, k));
    }
    drive(scene, end(strut.length), cases::unit(3, 0, -1.0), load);
    Solver solver(scene, 0.0);
    solver.step(1.0);
    cases::expect_near(solver.value("buckling_ratio"), 2.0, 1e-2, 2.0, "against Euler");
}

// Faces that touch without a force hold a film only where it can open to no side. A film that came off with the step
// counts as it is at its end.
TEST(small_rotations_tell_of_films) {
    Blister blister;
    const double strain = 3.0 * blister.critical();
    for (const bool below : {false, true}) {
        const Scene scene = blister.scene(strain, below, false, "linear");
        Solver solver(scene, 0.0);
        solver.step(1.0);
        cases::expect_near(solver.value("buckling_ratio"), 3.0, 3e-2, 3.0, "critical strain of a film");
    }
    const Scene covered = blister.scene(strain, false, true, "linear");
    Solver solver(covered, 0.0);
    solver.step(1.0);
    cases::expect_below(solver.value("buckling_ratio"), 0.2, "a film between two bases");
}

// The error of small rotations, where it is small, is that of loads: a cantilever under a force across and a pull.
TEST(small_rotations_tell_their_error) {
    for (const double pull : {0.0, 0.02}) {
        double error = 0.0, deflection[2] = {};
        int way = 0;
        for (const char* kinematics : {"linear", "corotational"}) {
            Scene scene = cases::make_blocks(2, {{{0.0, 0.0, 0.0}, {20.0, 0.5, 0.0}, {40, 2, 1}}}, nullptr);
            scene.begin();
            scene.elastic(-1, 1000.0, 0.0);
            scene.text("kinematics", kinematics);
            const auto load = scene.pattern("load", {0.0, 1.0}, {0.0, 1.0});
            const auto end = [&](double x) {
                return cases::nodes_where(scene, 0, [x](const double* p) { return std::abs(p[0] - x) < 1e-6; });
            };
            for (std::size_t k = 0; k < 2; ++k) hold(scene, end(0.0), cases::unit(2, static_cast<int>(k)));
            const std::vector<std::int64_t> tip = end(20.0);
            const double share = 1.0 / static_cast<double>(tip.size());
            std::vector<double> force;
            for (std::size_t n = 0; n < tip.size(); ++n) force.insert(force.end(), {share * pull, share * 0.0005});
            cases::forces(scene, load, tip, force);
            Solver solver(scene, 0.0);
            for (int k = 1; k <= 4; ++k) {
                solver.step(k / 4.0);
                solver.commit();
            }
            if (way == 0) error = solver.value("rotation_error");
            deflection[way++] = solver.field("displacement")[static_cast<std::size_t>(2 * tip.front() + 1)];
        }
        const double truth = std::abs(deflection[0] / deflection[1] - 1.0);
        if (pull > 0.0)
            cases::expect(0.2 * truth < error && error < 5.0 * truth && truth > 0.05, "error of a beam that is pulled");
        else
            cases::expect(error < 1e-2 && truth < 1e-2, "error of a beam that is bent");
    }
}

// A strip between two clamps that is pressed in the middle stretches, whatever its small rotations: the energy that
// they leave out is that of the stretch, in the plane and in space. Where an end may slide, they leave out little.
LOOP_TEST(small_rotations_leave_out_a_stretch, 0, 2) {
    const int d = 2 + loop;
    for (const bool slides : {false, true})
        for (const double deflection : {0.1, 0.5}) {
            double error = 0.0, stored[2] = {};
            for (const int way : {0, 1}) {
                Scene scene = d == 2
                                  ? cases::make_blocks(2, {{{0.0, 0.0, 0.0}, {20.0, 0.5, 0.0}, {40, 2, 1}}}, nullptr)
                                  : cases::make_blocks(3, {{{0.0, 0.0, 0.0}, {20.0, 1.0, 0.5}, {40, 1, 2}}}, nullptr);
                scene.begin();
                scene.elastic(-1, 1000.0, 0.0);
                scene.require(delam_problem_set_formulation(scene.problem(), -1, "incompatible"), "formulation");
                scene.text("kinematics", way == 0 ? "linear" : "corotational");
                const auto load = scene.pattern("load", {0.0, 1.0}, {0.0, deflection});
                const auto at = [&](double x) {
                    return cases::nodes_where(scene, 0, [x](const double* p) { return std::abs(p[0] - x) < 1e-6; });
                };
                for (int k = 0; k < d; ++k) {
                    hold(scene, at(0.0), cases::unit(d, k));
                    if (k > 0 || !slides) hold(scene, at(20.0), cases::unit(d, k));
                }
                drive(scene, at(10.0), cases::unit(d, d - 1), load);
                Solver solver(scene, 0.0);
                for (int k = 1; k <= 4; ++k) {
                    solver.step(k / 4.0);
                    solver.commit();
                }
                if (way == 0) error = solver.value("rotation_error");
                stored[way] = solver.value("stored_bulk");
            }
            const double truth = std::abs(stored[1] / stored[0] - 1.0);
            std::printf("%dD, %s: %.4g left out of %.4g, estimated %.4g\n", d, slides ? "slides" : "clamped",
                        stored[1] - stored[0], stored[0], error);
            if (slides)
                cases::expect(error < 5e-2 && truth < 5e-2, "an end that slides");
            else
                cases::expect(0.7 * truth < error && error < 1.4 * truth && truth > 0.01, "the stretch");
        }
}
