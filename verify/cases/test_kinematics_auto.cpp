// SPDX-License-Identifier: BSD-3-Clause
// kinematics = auto: rotations are small up to the step in which they leave out too much, and large from there on.
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "delam/experimental.h"
#include "rotating_beams.hpp"
#include "small_analysis.hpp"

namespace {

using namespace beams;
using reference::Solver;

}  // namespace

// Rotations become large in the step in which small ones leave out too much, which begins at the state before. Steps
// before it have the digits of small rotations, later ones the forces of large ones.
TEST(rotations_become_large_where_they_must) {
    const Beam beam{60.0, 0.5, 30.0, 240, 2};  // eight pairs in the process zone
    const Scene small = double_cantilever(beam, 12.0, "linear"), large = double_cantilever(beam, 12.0),
                either = double_cantilever(beam, 12.0, "auto");
    Solver linear(small, 0.0), turned(large, 0.0), chosen(either, 0.0);
    bool grown = false;
    std::vector<std::uint8_t> saved;
    for (int k = 1; k <= 20; ++k) {
        for (Solver* solver : {&linear, &turned, &chosen}) solver->step(k / 20.0);
        const bool now = linear.value("rotation_max") > 0.1;
        if (now && !grown) {  // the step that turns can be taken back
            const auto first = cases::read_bits(chosen);
            chosen.rollback();
            linear.rollback();
            cases::expect_same(chosen, cases::read_bits(chosen), cases::read_bits(linear), "taken back");
            for (Solver* solver : {&linear, &chosen}) solver->step(k / 20.0);
            cases::expect_same(chosen, cases::read_bits(chosen), first, "taken again");
        }
        grown = grown || now;
        for (Solver* solver : {&linear, &turned, &chosen}) solver->commit();
        const double force = turned.value("reaction:load");
        if (grown)
            cases::expect_near(chosen.value("reaction:load"), force, 1e-5, force, "force, step " + std::to_string(k));
        else
            cases::expect_same(chosen, cases::read_bits(chosen), cases::read_bits(linear), "small rotations");
        if (k == 2) cases::expect(!grown, "the first two steps have small rotations");
        if (k == 2 || k == 12) saved = chosen.save();
        if (k != 4 && k != 14) continue;
        Solver resumed(either, 0.0);  // from before the rotations are large, and from after
        either.require(resumed.load(saved), "delam_solver_load");
        for (int s = k - 1; s <= k; ++s) {
            resumed.step(s / 20.0);
            resumed.commit();
        }
        cases::expect_same(resumed, cases::read_bits(resumed), cases::read_bits(chosen), "saved and loaded");
    }
    cases::expect(grown && chosen.value("dissipated") > 0.0, "the crack grows with large rotations");
    for (const char* key : {"stored_bulk", "stored_interface", "dissipated"})
        cases::expect_near(chosen.value(key), turned.value(key), 1e-5, turned.value("work"), key);
    // Steps with small rotations have other parts than those with large ones.
    cases::expect_near(chosen.value("work"), turned.value("work"), 1e-4, turned.value("work"), "work");
}

// The upper of two layers is lifted off the lower one, which is held; its end goes straight up, so that it stretches.
Scene lifted(const Beam& beam, const char* kinematics) {
    Scene scene = beam.mesh();
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, young, 0.0);
    scene.law(0, equal_modes(3.0, 0.01));
    beam.cut(scene);
    scene.text("kinematics", kinematics);
    const auto load = scene.pattern("load", {0.0, 1.0}, {0.0, 0.2});
    const auto ground = cases::nodes_where(scene, 0, [](const double* p) { return p[1] < 1e-9; });
    const auto end = cases::nodes_where(scene, 1, [](const double* p) { return p[0] < 1e-9; });
    for (std::size_t k = 0; k < static_cast<std::size_t>(beam.dimension); ++k) scene.hold(ground, beam.along(k));
    scene.hold(end, beam.along(0));
    drive(scene, end, beam.along(1), load);
    return scene;
}

// While an interface comes off, rotations become large in the first step in which the energy that small ones leave out
// counts, although it is not computed in each.
LOOP_TEST(the_energy_of_a_stretch_is_known_when_it_counts, 0, 2) {
    const Beam beam{20.0, 1.0, 3.0, loop == 0 ? 80 : 40, 2, 0.0, 2 + loop, 1.0};
    const Scene small = lifted(beam, "linear"), either = lifted(beam, "auto");
    Solver linear(small, 0.0), chosen(either, 0.0);
    double left_out = 0.0;
    for (int k = 1; k <= 30 && !(left_out > 0.005); ++k) {
        for (Solver* solver : {&linear, &chosen}) {
            solver->step(k / 30.0);
            solver->commit();
        }
        left_out = linear.value("rotation_error");
        std::printf("step %d: %.4f of the energy is left out, rotations up to %.4f, %.2f open\n", k, left_out,
                    linear.value("rotation_max"), linear.value("debonded_length"));
        // Strains that know rotations leave out nothing.
        cases::expect((chosen.value("rotation_error") == 0.0) == (left_out > 0.005), "step " + std::to_string(k));
    }
    cases::expect(left_out > 0.005 && linear.value("rotation_max") < 0.1, "the stretch counts first");
    cases::expect(linear.value("debonded_length") > 6.0, "the crack has grown");
}

// A state with small rotations goes on under either, as those of versions whose default was linear do, and to the same
// digits. One with large rotations does not go on where they are small.
TEST(small_rotations_go_on_under_either) {
    const Beam beam{60.0, 0.5, 30.0, 240, 2};
    const Scene small = double_cantilever(beam, 12.0, "linear"), either = double_cantilever(beam, 12.0, "auto");
    const auto advance = [](Solver& solver, int k) {
        solver.step(k / 20.0);
        solver.commit();
    };
    Solver linear(small, 0.0), chosen(either, 0.0);
    for (int k = 1; k <= 2; ++k)
        for (Solver* solver : {&linear, &chosen}) advance(*solver, k);
    Solver of_linear(either, 0.0), of_chosen(small, 0.0);
    either.require(of_linear.load(linear.save()), "delam_solver_load, of linear");
    small.require(of_chosen.load(chosen.save()), "delam_solver_load, of auto");
    for (Solver* solver : {&linear, &chosen, &of_linear, &of_chosen}) advance(*solver, 3);
    cases::expect_same(of_chosen, cases::read_bits(of_chosen), cases::read_bits(linear), "auto goes on with linear");
    for (int k = 4; k <= 12; ++k)
        for (Solver* solver : {&chosen, &of_linear}) advance(*solver, k);
    const double force = chosen.value("reaction:load");
    cases::expect_near(of_linear.value("reaction:load"), force, 1e-9, force, "linear goes on with auto");
    const auto before = cases::read_bits(linear);
    cases::expect(linear.load(chosen.save()) == DELAM_ERROR_SNAPSHOT, "a state with large rotations is refused");
    const std::string said = delam_context_message(small.context());
    cases::expect(said.find("large rotations (kinematics = auto)") != std::string::npos, "refused: " + said);
    cases::expect_same(linear, cases::read_bits(linear), before, "the refusal leaves the solver as it was");
}

// Scenes that large rotations do not know stay as they are, and the plan says why.
TEST(rotations_that_cannot_become_large) {
    Scene scene = double_cantilever({30.0, 0.5, 10.0, 60, 2}, 10.0, "auto");
    scene.text("backtracking", "on");
    Solver solver(scene, 0.0);
    solver.step(1.0);
    cases::expect_below(0.2, solver.value("rotation_max"), "rotation");
    const std::string plan = delam_solver_plan(solver.get());
    cases::expect(
        plan.find("large rotations: left out, option kinematics = auto: they do not know backtracking = on") !=
            std::string::npos,
        plan);
}

// So do those whose sensitivities are followed, with all digits of small rotations.
TEST(rotations_stay_small_where_sensitivities_are_followed) {
    std::vector<std::vector<double>> found;
    for (const char* kinematics : {"linear", "auto"}) {
        const Scene scene = double_cantilever({30.0, 0.5, 10.0, 60, 2}, 3.0, kinematics);
        Solver solver(scene, 0.0);
        const std::int64_t interface = 0;
        scene.require(delam_experimental_solver_follow(solver.get(), 1, &interface, "normal_toughness", nullptr),
                      "delam_experimental_solver_follow");
        for (int k = 1; k <= 4; ++k) {
            solver.step(k / 4.0);
            solver.commit();
        }
        cases::expect_below(0.2, solver.value("rotation_max"), "rotation");
        std::vector<double>& own = found.emplace_back(1);
        scene.require(delam_experimental_solver_sensitivity(solver.get(), 1, own.data(), nullptr),
                      "delam_experimental_solver_sensitivity");
        for (const char* key : {"reaction:load", "dissipated", "stored_bulk"}) own.push_back(solver.value(key));
        const std::string plan = delam_solver_plan(solver.get());
        const bool told = plan.find("they do not know sensitivities") != std::string::npos;
        cases::expect(told == (std::string(kinematics) == "auto"), plan);
    }
    cases::expect(found[0][0] != 0.0, "the toughness matters, or nothing was tested");
    for (std::size_t i = 0; i < found[0].size(); ++i)
        cases::expect_near(found[1][i], found[0][i], 0.0, std::abs(found[0][i]), "number " + std::to_string(i));
}

// Iterated operators have unknowns of their own, which bodies that rotate do not know.
LOOP_TEST(rotations_become_large_with_every_operator, 0, 2) {
    const Beam beam{60.0, 0.5, 20.0, 120, 2};
    std::vector<double> force;
    for (const char* kinematics : {"auto", "corotational"}) {
        Scene scene = double_cantilever(beam, 6.0, kinematics);
        scene.text("reduction", loop == 0 ? "condensed" : "iterated");
        Solver solver(scene, 0.0);
        for (int k = 1; k <= 8; ++k) {
            solver.step(k / 8.0);
            solver.commit();
        }
        cases::expect(solver.value("dissipated") > 0.0, "nothing is damaged: nothing was tested");
        force.push_back(solver.value("reaction:load"));
    }
    cases::expect_near(force[0], force[1], 1e-5, force[1], "force");
}

// A layer that is pulled first and pressed then: stresses that do not make it buckle say nothing of those that do.
TEST(rotations_become_large_where_loads_turn_round) {
    Scene scene = cases::make_blocks(2, {{{0.0, 0.0, 0.0}, {20.0, 0.5, 0.0}, {40, 2, 1}}});
    scene.begin();
    scene.elastic(-1, 1e3, 0.0);
    scene.text("kinematics", "auto");
    const double critical = std::pow(std::acos(-1.0), 2) * 0.25 / 60.0;  // pi^2 h^2 / (3 L)
    const auto load = scene.pattern("load", {0.0, 1.0, 2.0}, {0.0, -0.5 * critical, 2.0 * critical});
    const auto ends = [&](double x) {
        return cases::nodes_where(scene, 0, [&](const double* p) { return std::abs(p[0] - x) < 1e-9; });
    };
    for (int k = 0; k < 2; ++k) scene.hold(ends(0.0), cases::unit(2, k));
    scene.hold(ends(20.0), cases::unit(2, 1));
    drive(scene, ends(20.0), {-1.0, 0.0}, load);
    Solver solver(scene, 0.0);
    double modes = 0.0;
    for (int k = 1; k <= 20; ++k) {
        solver.step(0.1 * k);
        solver.commit();
        modes += solver.value("buckling_modes");
    }
    cases::expect(modes > 0.0, "the layer stays flat");
}

// A host that changes a history on the way gets the loads of the new one, whether rotations are large by then or become
// so later, and so does an analysis that is resumed.
LOOP_TEST(histories_change_on_the_way, 0, 2) {
    const Beam beam{40.0, 0.5, 20.0, 80, 2};
    const char* kinematics = loop == 0 ? "corotational" : "auto";
    const Scene scene = double_cantilever(beam, 8.0, kinematics), other = double_cantilever(beam, 5.0, kinematics);
    Solver solver(scene, 0.0), expected(other, 0.0);
    const double opened[] = {1.6, 3.2, 3.8, 4.4, 5.0};
    std::vector<std::uint8_t> saved;
    for (int k = 1; k <= 5; ++k) {
        const double time = 1.0, value = 5.0;
        if (k == 3) REQUIRE(scene, delam_solver_set_history, solver.get(), 0, 1, &time, &value);
        solver.step(0.2 * k);
        expected.step(opened[k - 1] / 5.0);
        for (Solver* one : {&solver, &expected}) one->commit();
        for (const char* key : {"reaction:load", "work", "dissipated"})
            cases::expect_near(solver.value(key), expected.value(key), 1e-6, expected.value("work"), key);
        if (k == 3) saved = solver.save();
    }
    Solver resumed(scene, 0.0);
    scene.require(resumed.load(saved), "delam_solver_load");
    for (int k = 4; k <= 5; ++k) {
        resumed.step(0.2 * k);
        resumed.commit();
    }
    cases::expect_same(resumed, cases::read_bits(resumed), cases::read_bits(solver), "saved and loaded");
}

// A step with a located jump has no tangent; once a host has asked for one, it is taken whole and has.
TEST(tangents_end_the_search_for_jumps) {
    const Scene scene = flexure({100.0, 1.0, 12.0, 200, 2}, equal_modes(12.0, 0.1), 6.0, "corotational");
    Solver solver(scene, 0.0);
    double tangent = 0.0;
    for (int k = 1; k <= 3; ++k) {
        solver.step(k / 6.0);
        solver.commit();
    }
    solver.step(4.0 / 6.0);
    cases::expect(solver.value("substeps") > 1.0, "the jump is not located");
    cases::expect(delam_solver_step_tangent(solver.get(), 1, &tangent) == DELAM_ERROR_STATE, "a tangent of substeps");
    solver.rollback();
    solver.step(4.0 / 6.0);
    cases::expect(solver.value("substeps") == 1.0, "the step is not whole");
    cases::expect(delam_solver_step_tangent(solver.get(), 1, &tangent) == DELAM_OK, "a step that is whole");
}

// An analysis that is saved goes on to the same jump.
TEST(saved_analysis_locates_its_jump) {
    const Scene scene = flexure({100.0, 1.0, 12.0, 200, 2}, equal_modes(12.0, 0.1), 6.0, "corotational");
    Solver whole(scene, 0.0), resumed(scene, 0.0);
    for (int k = 1; k <= 4; ++k) {
        whole.step(k / 6.0);
        whole.commit();
        if (k == 3) scene.require(resumed.load(whole.save()), "delam_solver_load");
    }
    resumed.step(4.0 / 6.0);
    resumed.commit();
    cases::expect(whole.value("jumps") == 1.0, "the jump is located");
    cases::expect_same(resumed, cases::read_bits(resumed), cases::read_bits(whole), "in the end");
}
