// SPDX-License-Identifier: BSD-3-Clause
// Bodies with large rotations that come off entirely, or that nothing holds from the start: they keep their places, no
// stress stays in them, and the balance closes.
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

struct Kind {
    int dimension;
    const char* reduction;
};
constexpr std::array<Kind, 3> kinds{{{2, "auto"}, {3, "condensed"}, {3, "iterated"}}};

// A film on a base that is held, strained along and back by a pattern.
struct Film {
    Beam beam{20.0, 0.5, 0.0, 10, 1};
    bool bonded = true;

    explicit Film(const Kind& kind) {
        beam.dimension = kind.dimension;
        if (kind.dimension == 3) beam.width = 4.0;
    }
    Scene scene(const char* kinematics, const char* reduction) const {
        Scene scene = beam.mesh();
        scene.interface(0, 1);
        scene.begin();
        scene.elastic(-1, 100e3, 0.3);
        scene.law(0, beams::equal_modes(30.0, 0.05));
        if (!bonded) scene.adhesion(0, every_pair(scene), std::vector<double>(scene.pairs(0).count(), 0.0));
        scene.text("kinematics", kinematics);
        scene.text("reduction", reduction);
        const std::vector<std::int64_t> base =
            cases::nodes_where(scene, 0, [](const double* p) { return p[1] < 1e-9; });
        for (std::size_t axis = 0; axis < static_cast<std::size_t>(beam.dimension); ++axis)
            scene.hold(base, beam.along(axis));
        const std::int64_t heat = scene.pattern("heat", {0.0, 1.0, 2.0, 3.0}, {0.0, 1.0, -1.0, 1.0});
        const std::vector<double> strain{8e-3, 8e-3, beam.dimension == 3 ? 8e-3 : 0.0, 0.0, 0.0, 0.0};
        scene.require(delam_problem_add_eigenstrain(scene.problem(), heat, 1, strain.data()),
                      "delam_problem_add_eigenstrain");
        return scene;
    }
    static std::vector<std::int64_t> every_pair(const Scene& scene) {
        std::vector<std::int64_t> pairs(scene.pairs(0).count());
        for (std::size_t p = 0; p < pairs.size(); ++p) pairs[p] = static_cast<std::int64_t>(p);
        return pairs;
    }
};

void advance(Solver& solver, double time) {
    solver.step(time);
    solver.commit();
}

// A film that is heated comes off, whole, and stays where it is as it is cooled and heated again.
LOOP_TEST(film_comes_off_and_stays, 0, 3) {
    const Kind& kind = kinds[static_cast<std::size_t>(loop)];
    const Film film(kind);
    const Scene turned = film.scene("corotational", kind.reduction), straight = film.scene("linear", kind.reduction);
    Solver solver(turned, 0.0), linear(straight, 0.0);
    for (int k = 1; k <= 12; ++k) {
        advance(linear, 0.25 * k);
        advance(solver, 0.25 * k);
        const std::string at = " after step " + std::to_string(k);
        if (k < 4) continue;
        cases::expect_near(solver.value("dissipated"), linear.value("dissipated"), 1e-2, linear.value("dissipated"),
                           "dissipated energy" + at);
        cases::expect(solver.value("free_bodies") == 1.0, "the film is free" + at);
        cases::expect_below(solver.value("stored_bulk"), 1e-6 * solver.value("dissipated"), "stored energy" + at);
    }
    const std::vector<double> u = solver.field("displacement");
    // It is as long as its strain says, and no face passes through the base.
    const auto dim = static_cast<std::size_t>(kind.dimension);
    const auto along = [&](double x) {
        return u[static_cast<std::size_t>(film.beam.nodes(turned, 1, x, 1.0).front()) * dim];
    };
    cases::expect_near(along(20.0) - along(0.0), 8e-3 * 20.0, 1e-3, 0.16, "change of length");
    const std::vector<double> jump = solver.field("jump");
    for (std::size_t p = 0; p < jump.size(); p += dim) cases::expect_below(-1e-9, jump[p], "no penetration");
}

// An analysis that is saved after the film has come off goes on alike, bit by bit.
LOOP_TEST(film_that_is_off_is_saved, 0, 3) {
    const Kind& kind = kinds[static_cast<std::size_t>(loop)];
    const Scene scene = Film(kind).scene("corotational", kind.reduction);
    Solver solver(scene, 0.0);
    for (int k = 1; k <= 5; ++k) advance(solver, 0.25 * k);
    cases::expect(solver.value("free_bodies") == 1.0, "the film is free");
    Solver resumed(scene, 0.0);
    scene.require(resumed.load(solver.save()), "delam_solver_load");
    for (Solver* one : {&solver, &resumed}) advance(*one, 1.5);
    cases::expect_same(resumed, cases::read_bits(resumed), cases::read_bits(solver), "one step on");
}

// A film that never held on is free from the start.
LOOP_TEST(film_lies_on_a_base, 0, 3) {
    const Kind& kind = kinds[static_cast<std::size_t>(loop)];
    Film film(kind);
    film.bonded = false;
    const Scene scene = film.scene("corotational", kind.reduction);
    Solver solver(scene, 0.0);
    cases::expect(solver.value("free_bodies") == 1.0, "the film is free");
    for (int k = 1; k <= 4; ++k) {
        advance(solver, 0.5 * k);
        // Elastic energy that holds the strains back: E e^2 of the whole film.
        cases::expect_below(solver.value("stored_bulk"), 1e-9 * 100e3 * 64e-6 * 10.0, "stored energy");
    }
}

// Arms of a double cantilever beam are pulled apart until they are two: all that is dissipated is the toughness of the
// whole interface, and the springs of the arms go slack.
TEST(arms_come_apart) {
    const Beam beam{20.0, 0.5, 4.0, 40, 2};
    const Scene scene = beams::double_cantilever(beam, 16.0);
    Solver solver(scene, 0.0);
    double released = 0.0;
    for (int k = 1; k <= 16; ++k) {
        advance(solver, k / 16.0);
        released += solver.value("released");
    }
    const double whole = 0.5 * 16.0;  // toughness times length
    cases::expect_near(solver.value("dissipated"), whole, 2e-2, whole, "dissipated energy");
    cases::expect_below(std::abs(solver.value("reaction:load")), 1e-6 * whole, "the arms are slack");
    cases::expect_below(solver.value("stored_bulk"), 1e-6 * whole, "stored energy");
    cases::expect_near(solver.value("work"), whole + released, 3e-2, whole, "balance");
    cases::expect_below(1.0, released, "what the arms store until then is released");
}

// Nothing holds a plate against a dead force: that is said, whether rotations are small or large.
TEST(dead_force_on_a_loose_body_is_refused) {
    for (const char* kinematics : {"linear", "corotational"}) {
        const Film film(kinds[0]);
        Scene scene = film.scene(kinematics, "auto");
        const std::int64_t push = scene.pattern("push", {0.0, 3.0}, {0.0, 300.0});
        const std::vector<std::int64_t> end = film.beam.nodes(scene, 1, 20.0, 1.0);
        const std::array<double, 2> force{1.0, 0.0};
        scene.require(delam_problem_add_forces(scene.problem(), push, 1, end.data(), force.data(), 0),
                      "delam_problem_add_forces");
        Solver solver(scene, 0.0);
        std::int32_t status = DELAM_OK;
        for (int k = 1; k <= 4 && status == DELAM_OK; ++k) {
            status = solver.advance(0.25 * k);
            if (status == DELAM_OK) solver.commit();
        }
        cases::expect(status == DELAM_LIMIT, std::string("refused, ") + kinematics + ", " + delam_status_name(status));
        cases::expect(
            std::string(delam_context_message(scene.context())).find("'push' acts on body 1") != std::string::npos,
            std::string("says how, ") + kinematics + ": " + delam_context_message(scene.context()));
    }
}

}  // namespace
