// SPDX-License-Identifier: BSD-3-Clause
// Eigenstrains of bodies that rotate much: a strip of two layers that heat bends into a circle, heat that strains a
// turned body without stresses, a strut that buckles between walls as it is heated, and derivatives, saved states and
// kinematics = auto with them.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "condensed_scenes.hpp"
#include "rotating_beams.hpp"
#include "small_analysis.hpp"
#include "support.hpp"

namespace {

using beams::Beam;
using reference::Scene;
using reference::Solver;

constexpr double pi = 3.141592653589793;

std::int64_t heat(Scene& scene, std::int32_t body, const std::vector<double>& strain,
                  const std::vector<double>& factors = {0.0, 1.0}, const char* name = "heat") {
    std::vector<double> times;
    for (std::size_t i = 0; i < factors.size(); ++i)
        times.push_back(static_cast<double>(i) / static_cast<double>(factors.size() - 1));
    const std::int64_t pattern = scene.pattern(name, times, factors);
    scene.require(delam_problem_add_eigenstrain(scene.problem(), pattern, body, strain.data()),
                  "delam_problem_add_eigenstrain");
    return pattern;
}

// Two layers, held at the left end, of which the lower one becomes longer by the strain e along the strip: the
// curvature is 3/4 e over the height of a layer (S. Timoshenko, J. Opt. Soc. Am. 11 (1925) 233-255, for equal layers).
struct Strip {
    double strain = 0.01;
    Beam beam{60.0, 0.5, 0.0, 60, 2};
    double curvature() const { return 0.75 * strain / beam.height; }

    Scene scene(const char* kinematics) const {
        Scene scene = beam.mesh();
        scene.interface(0, 1);
        scene.begin();
        scene.elastic(-1, beams::young, 0.0);
        scene.bonded(0);
        scene.text("kinematics", kinematics);
        const double c = std::cos(beam.angle), s = std::sin(beam.angle);
        heat(scene, 0, {c * c * strain, s * s * strain, 0.0, 2.0 * c * s * strain, 0.0, 0.0});
        const std::vector<std::int64_t> held = beam.nodes(scene, 1, 0.0, beam.height);
        for (std::size_t axis = 0; axis < index(beam.dimension); ++axis) scene.hold(held, beam.along(axis));
        scene.hold(beam.nodes(scene, 1, 0.0, 2.0 * beam.height), beam.along(0));
        return scene;
    }
    static std::size_t index(int i) { return static_cast<std::size_t>(i); }
};

// Returns where the middle of the right end has moved to, in the axes of the strip.
std::array<double, 2> tip(const Strip& strip, const Scene& scene, const Solver& solver) {
    const std::vector<double> u = solver.field("displacement");
    const auto node =
        static_cast<std::size_t>(strip.beam.nodes(scene, 1, strip.beam.length, strip.beam.height).front());
    const auto dim = Strip::index(strip.beam.dimension);
    std::array<double, 2> moved{};
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const std::vector<double> e = strip.beam.along(axis);
        for (std::size_t k = 0; k < dim; ++k) moved[axis] += e[k] * u[node * dim + k];
    }
    return moved;
}

// The strip becomes the arc of a circle, whose stresses are those of small rotations.
LOOP_TEST(heated_strip_bends_into_a_circle, 0, 3) {
    Strip strip;
    if (loop == 1) strip.beam.angle = 2.5;
    if (loop == 2) strip.beam.dimension = 3, strip.beam.width = 1.0;
    const Scene scene = strip.scene("corotational");
    Solver solver(scene, 0.0);
    for (int k = 1; k <= 4; ++k) {
        solver.step(k / 4.0);
        solver.commit();
        const double angle = strip.curvature() * strip.beam.length * k / 4.0;
        // The interface is stretched by e/2.
        const double radius = (1.0 + 0.5 * strip.strain * k / 4.0) / (strip.curvature() * k / 4.0);
        const std::array<double, 2> moved = tip(strip, scene, solver);
        const double rise = radius * (1.0 - std::cos(angle)), shortening = radius * std::sin(angle) - strip.beam.length;
        cases::expect_near(moved[1], rise, 3e-3, rise, "rise of the end");
        cases::expect_near(moved[0], shortening, 3e-3, rise, "shortening of the chord");
        cases::expect_near(solver.value("rotation_max"), angle, 2e-2, angle, "rotation of the last cell");
    }
    const Scene straight = strip.scene("linear");
    Solver linear(straight, 0.0);
    linear.step(1.0);
    linear.commit();
    for (const char* key : {"stored_bulk", "reaction:heat"})
        cases::expect_near(solver.value(key), linear.value(key), 1e-3, linear.value("stored_bulk"), key);
    // Frames turn the stresses back before they are compared with their nodal means.
    const double of_mesh = linear.value("mesh_error");
    cases::expect(of_mesh > 1e-6, "there is an error of the mesh, or nothing was tested: " + std::to_string(of_mesh));
    cases::expect_near(solver.value("mesh_error"), of_mesh, 0.05, of_mesh, "error of the mesh");
    cases::expect(tip(strip, straight, linear)[1] > 1.05 * tip(strip, scene, solver)[1],
                  "small rotations rise too far");
}

// Stresses in global axes turn with the strip: along it and at its end they are those at its middle.
TEST(stresses_turn_with_the_strip) {
    const Strip strip;
    const Scene scene = strip.scene("corotational");
    Solver solver(scene, 0.0);
    solver.step(1.0);
    solver.commit();
    const std::vector<double> stress = solver.field("stress"), rotation = solver.field("rotation");
    const auto along = [&](std::size_t cell) {
        const double c = std::cos(rotation[cell]), s = std::sin(rotation[cell]);
        return c * c * stress[4 * cell] + s * s * stress[4 * cell + 1] + 2.0 * c * s * stress[4 * cell + 3];
    };
    for (std::size_t row = 0; row < 4; ++row) {
        const double middle = along(60 * row + 30);
        cases::expect(std::abs(middle) > 10.0, "there is a stress");
        for (const std::size_t cell : {10U, 40U, 50U})
            cases::expect_near(along(60 * row + cell), middle, 5e-3, 100.0, "stress along the strip");
    }
}

// A body that nothing holds but its place and its angle keeps its stresses at zero, whatever heats and turns it.
LOOP_TEST(free_strains_have_no_stresses, 2, 4) {
    Beam beam{4.0, 1.0, 0.0, 4, 2, 0.4, loop, 1.0};
    Scene scene = beam.mesh(1);
    scene.begin();
    scene.elastic(-1, beams::young, 0.3);
    scene.text("kinematics", "corotational");
    heat(scene, 0, {0.01, -0.02, loop == 2 ? 0.0 : 0.005, 0.015, 0.0, 0.0});
    // The line y = 0 at x = 0 stays; a further place moves by as much as the strains and a turn ask for.
    const std::vector<std::int64_t> held = beam.nodes(scene, 0, 0.0, 0.0);
    for (std::size_t axis = 0; axis < Strip::index(loop); ++axis)
        if (axis < 2) scene.hold(held, beam.along(axis));
    if (loop == 3) scene.hold({held.front()}, beam.along(2));
    if (loop == 3) scene.hold({beam.nodes(scene, 0, 4.0, 0.0).front()}, beam.along(2));
    const auto turn = scene.pattern("turn", {0.0, 1.0}, {0.0, 2.5});
    beams::drive(scene, {beam.nodes(scene, 0, 4.0, 0.0).front()}, beam.along(1), turn);
    Solver solver(scene, 0.0);
    for (int k = 1; k <= 5; ++k) {
        solver.step(k / 5.0);
        solver.commit();
        const double whole = beams::young * 0.01 * 0.01 * 4.0;
        cases::expect_below(std::abs(solver.value("stored_bulk")), 1e-11 * whole, "energy");
        const std::vector<double> stress = solver.field("stress");
        const std::size_t columns = loop == 2 ? 4 : 6;
        for (std::size_t i = 0; i < stress.size(); ++i)
            if (loop == 3 || i % columns != 2)
                cases::expect_below(std::abs(stress[i]), 1e-5 * beams::young * 0.01, "stress");
    }
    cases::expect_below(0.5, solver.value("rotation_max"), "rotation");
}

// Between walls a strut buckles as its hindered strain reaches pi^2 h^2 / 3 l^2, and rises as an elastica does.
TEST(heated_strut_buckles_between_walls) {
    constexpr double length = 20.0, height = 0.5, critical = pi * pi * height * height / (3.0 * length * length);
    const Beam beam{length, height, 0.0, 40, 2};
    for (const char* kinematics : {"corotational", "auto"}) {
        Scene scene = beam.mesh(1);
        scene.begin();
        scene.elastic(-1, 1000.0, 0.0);
        scene.text("kinematics", kinematics);
        heat(scene, -1, {3.0 * critical, 0.0, 0.0, 0.0, 0.0, 0.0});
        for (const double x : {0.0, length}) {
            const auto end = cases::nodes_where(scene, 0, [&](const double* p) { return std::abs(p[0] - x) < 1e-6; });
            for (std::size_t axis = 0; axis < 2; ++axis) scene.hold(end, beam.along(axis));
        }
        Solver solver(scene, 0.0);
        double modes = 0.0, begun = 0.0;
        for (int k = 1; k <= 12; ++k) {
            solver.step(k / 12.0);
            solver.commit();
            modes += solver.value("buckling_modes");
            if (solver.value("buckling_modes") > 0.0) begun = solver.value("buckling_time");
        }
        cases::expect_near(modes, 1.0, 1e-12, 1.0, "modes of buckling");
        cases::expect_near(begun, 1.0 / 3.0, 2e-2, 1.0 / 3.0, "critical factor");
        // The rise of a shallow arch: what the axis is too long by, 2/3 of the strain, is pi^2 a^2 / 4 l^2.
        const std::vector<double> u = solver.field("displacement");
        double rise = 0.0;
        for (std::size_t i = 1; i < u.size(); i += 2) rise = std::max(rise, std::abs(u[i]));
        const double expected = 2.0 * length / pi * std::sqrt(2.0 * critical);
        cases::expect_near(rise, expected, 2e-2, expected, "rise");
        cases::expect_near(solver.value("work"), solver.value("stored_bulk"), 5e-3, solver.value("stored_bulk"),
                           "balance");
    }
}

// A film of two layers above a base from which it is off but for its first cells: it curls up by more than half a turn,
// through the angle at which its faces and those of the base have no mean frame, as if the base were not there.
TEST(curled_film) {
    constexpr double attached = 5.0, length = 30.0, thickness = 0.1, strain = 0.03;
    constexpr double curvature = 0.75 * strain / thickness;
    Scene scene =
        cases::make_blocks(2, {{{0.0, 0.0, 0.0}, {length, 1.0, 0.0}, {30, 1, 1}},
                               {{0.0, 1.0, 0.0}, {length, 1.0 + thickness, 0.0}, {30, 1, 1}},
                               {{0.0, 1.0 + thickness, 0.0}, {length, 1.0 + 2.0 * thickness, 0.0}, {30, 1, 1}}});
    scene.interface(0, 1);
    scene.interface(1, 2);
    scene.begin();
    scene.elastic(-1, beams::young, 0.0);
    scene.law(0, beams::equal_modes(1e4, 1e6));
    scene.bonded(1);
    std::vector<std::int64_t> off;
    const auto pairs = scene.pairs(0);
    for (std::size_t p = 0; p < pairs.count(); ++p)
        if (scene.coordinate(pairs.node_b[p], 0) > attached + 1e-6) off.push_back(static_cast<std::int64_t>(p));
    scene.adhesion(0, off, std::vector<double>(off.size(), 0.0));
    scene.text("kinematics", "corotational");
    heat(scene, 1, {strain, 0.0, 0.0, 0.0, 0.0, 0.0});
    const auto base = cases::nodes_where(scene, 0, [](const double* x) { return x[1] < 1e-6; });
    for (int k = 0; k < 2; ++k) scene.hold(base, cases::unit(2, k));
    const std::int64_t end = cases::nodes_where(scene, 2, [](const double* x) {
                                 return x[0] > length - 1e-6 && x[1] < 1.0 + 1.5 * thickness;
                             }).front();
    Solver solver(scene, 0.0);
    constexpr int steps = 24;
    for (int k = 1; k <= steps; ++k) {
        solver.step(static_cast<double>(k) / steps);
        solver.commit();
        const double part = static_cast<double>(k) / steps, bend = curvature * part;
        const double free = (length - attached) * (1.0 + 0.5 * strain * part), angle = bend * free;
        const std::vector<double> u = solver.field("displacement");
        const auto at = static_cast<std::size_t>(2 * end);
        cases::expect_near(length + u[at], attached + std::sin(angle) / bend, 1.0, 1.0,
                           "place of the end along the base");
        cases::expect_near(u[at + 1], (1.0 - std::cos(angle)) / bend, 1.0, 1.0, "height of the end");
        cases::expect(solver.value("dissipated") == 0.0, "the film holds where it is attached");
    }
    cases::expect_below(5.5, curvature * (length - attached), "angle at the end");
}

// One step that is too long for the iterations is cut, by default and with adaptive steps, and not with fixed ones.
TEST(steps_that_are_too_long_are_cut) {
    Strip strip;
    strip.strain = 0.3;
    strip.beam = {60.0, 0.5, 0.0, 60, 2};

    const auto run = [&](const char* control, int steps, double& energy) {
        Scene scene = strip.scene("corotational");
        scene.text("step_control", control);
        Solver solver(scene, 0.0);
        std::int32_t status = DELAM_OK;
        for (int k = 1; k <= steps && status == DELAM_OK; ++k) {
            status = solver.advance(static_cast<double>(k) / steps);
            if (status == DELAM_OK) solver.commit();
        }
        energy = solver.value("stored_bulk");
        return status;
    };
    double in_many = 0.0, in_one = 0.0;
    cases::expect(run("fixed", 24, in_many) == DELAM_OK, "many steps");
    cases::expect(run("fixed", 1, in_one) != DELAM_OK, "one step of fixed length does not converge");
    for (const char* control : {"auto", "adaptive"}) {
        cases::expect(run(control, 1, in_one) == DELAM_OK, std::string("one step, step_control = ") + control);
        cases::expect_near(in_one, in_many, 1e-5, in_many, "energy in one step and in many");
    }
}

// The derivative of the energy with respect to the factor of a strain, and its own derivative, against differences.
TEST(derivatives_with_respect_to_strains) {
    Strip strip;
    strip.beam = {20.0, 0.5, 0.0, 20, 2};
    const Scene scene = strip.scene("corotational");
    Solver solver(scene, 0.0);
    solver.step(0.5);
    solver.commit();
    const std::vector<double> adhesion = solver.field("adhesion");
    double tangent = 0.0;
    scene.require(delam_solver_tangent(solver.get(), 1, &tangent), "delam_solver_tangent");
    const double slope = solver.value("reaction:heat");
    const auto at = [&](double time, const char* key) {
        solver.equilibrate(time, adhesion);
        const double value = solver.value(key);
        solver.rollback();
        return value;
    };
    constexpr double h = 4e-3;
    const double difference = (at(0.5 + h, "stored_bulk") - at(0.5 - h, "stored_bulk")) / (2.0 * h);
    cases::expect_near(slope, difference, 1e-6, difference, "first derivative");
    const double second = (at(0.5 + h, "reaction:heat") - at(0.5 - h, "reaction:heat")) / (2.0 * h);
    cases::expect_near(tangent, second, 1e-6, second, "second derivative");
}

// A double cantilever beam whose arms are strained: it turns within the analysis, and is saved before and after.
TEST(strained_beams_turn_and_are_saved) {
    const Beam beam{30.0, 0.5, 10.0, 60, 2};
    const auto scene_of = [&](const char* kinematics) {
        Scene scene = beams::double_cantilever(beam, 5.0, kinematics);
        heat(scene, 0, {1e-3, 0.0, 0.0, 0.0, 0.0, 0.0}, {1.0, 1.0});
        heat(scene, 1, {-1e-3, 1e-3, 0.0, 0.0, 0.0, 0.0}, {1.0, 1.0}, "swell");
        return scene;
    };
    const Scene either = scene_of("auto"), large = scene_of("corotational");
    Solver chosen(either, 0.0), turned(large, 0.0);
    const double initial = turned.value("stored_bulk") + turned.value("stored_interface");
    for (int k = 1; k <= 12; ++k) {
        for (Solver* solver : {&turned, &chosen}) {
            solver->step(k / 12.0);
            solver->commit();
        }
        if (k % 3 != 0) continue;
        for (Solver* solver : {&turned, &chosen}) {
            Solver resumed(solver == &chosen ? either : large, 0.0);
            either.require(resumed.load(solver->save()), "delam_solver_load");
            cases::expect_same(resumed, cases::read_bits(resumed), cases::read_bits(*solver), "saved and loaded");
            const auto state = solver->save();
            for (Solver* one : {solver, &resumed}) {
                one->step((k + 0.5) / 12.0);
                one->commit();
            }
            cases::expect_same(resumed, cases::read_bits(resumed), cases::read_bits(*solver),
                               std::string(solver == &chosen ? "auto" : "corotational") + ", one step on from step " +
                                   std::to_string(k));
            either.require(solver->load(state), "delam_solver_load");
        }
    }
    cases::expect_below(0.0, chosen.value("dissipated"), "a crack grows");
    cases::expect_below(0.15, chosen.value("rotation_max"), "arms rotate");
    for (const char* key : {"stored_bulk", "dissipated", "reaction:load"})
        cases::expect_near(chosen.value(key), turned.value(key), 1e-2, turned.value(key), key);
    const double energy = turned.value("stored_bulk") + turned.value("stored_interface") + turned.value("dissipated");
    cases::expect_near(energy + turned.value("released") - initial, turned.value("work"), 1e-2, energy, "balance");
}

}  // namespace
