// SPDX-License-Identifier: BSD-3-Clause
// Rigid planes beside bodies that rotate much: a film that is peeled off one, a beam whose end one moves and slides
// along, and what is refused.
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "condensed_scenes.hpp"
#include "elastica.hpp"
#include "rotating_beams.hpp"
#include "small_analysis.hpp"
#include "support.hpp"

namespace {

using beams::Beam;
using reference::Scene;
using reference::Solver;

struct Case {
    int dimension;
    double angle;
    const char* reduction;
};
constexpr std::array<Case, 4> film_cases{
    {{2, 0.0, "auto"}, {2, 2.2, "auto"}, {3, 0.0, "condensed"}, {3, 0.9, "iterated"}}};

// A layer whose node 0 belongs to no body.
Scene layer(const Beam& beam) {
    return cases::make_blocks(
        beam.dimension, {{{0.0, 0.0, 0.0}, {beam.length, beam.height, beam.width}, {beam.cells, beam.across, 1}}},
        [&](const std::array<double, 3>& x) { return beam.turned(x); }, 1);
}

std::vector<double> normals(const std::vector<std::int64_t>& nodes, const std::vector<double>& normal) {
    std::vector<double> all;
    for (std::size_t i = 0; i < nodes.size(); ++i) all.insert(all.end(), normal.begin(), normal.end());
    return all;
}

void hold_control(Scene& scene, int dimension) {
    for (int k = 0; k < dimension; ++k) scene.hold({0}, cases::unit(dimension, k));
}

// The force across a film on a rigid plane tends to the toughness, in whatever direction the plane lies.
LOOP_TEST(film_is_peeled_off_a_plane, 0, 4) {
    const Case& kind = film_cases[static_cast<std::size_t>(loop)];
    const double width = kind.dimension == 3 ? 0.1 : 1.0;
    Beam beam{10.0, 0.1, 2.0, 100, 1, kind.angle, kind.dimension, kind.dimension == 3 ? width : 0.0};
    Scene scene = layer(beam);
    const double c = std::cos(kind.angle), s = std::sin(kind.angle);
    const auto face =
        cases::nodes_where(scene, 0, [&](const double* x) { return std::abs(-s * x[0] + c * x[1]) < 1e-9; });
    scene.obstacle(face, normals(face, beam.along(1)), 0);
    scene.begin();
    scene.elastic(-1, beams::young, 0.0);
    scene.law(0, beams::equal_modes(20.0, 0.5));
    beam.cut(scene);
    scene.text("kinematics", "corotational");
    scene.text("reduction", kind.reduction);
    hold_control(scene, kind.dimension);
    if (kind.dimension == 3)
        scene.hold(cases::nodes_where(scene, 0, [](const double* p) { return p[2] < 1e-9; }), beam.along(2));
    const auto load = scene.pattern("load", {0.0, 1.0}, {0.0, 5.0});
    beams::drive(scene, beam.nodes(scene, 0, 0.0, 0.1), beam.along(1), load);
    Solver solver(scene, 0.0);
    for (int k = 1; k <= 20; ++k) {
        solver.step(k / 20.0);
        solver.commit();
    }
    const cases::Arm arm = cases::growing_arm(beams::bending_stiffness(beams::young, 0.1), 0.5, 5.0);
    cases::expect_near(solver.value("reaction:load") / width, arm.force, 1e-2, arm.force, "force");
    cases::expect_below(0.9, solver.value("rotation_max"), "rotation");
}

// The end of a cantilever is moved by a smooth plane, along which it slides by a third of its length. P L^2 / (E I) = 4
// deflects it by 0.66996 L and shortens it by 0.32894 L (K. Bisshopp, D. Drucker, Quart. Appl. Math. 3, 1945).
LOOP_TEST(end_slides_along_a_plane, 0, 2) {
    const Beam beam{100.0, 1.0, 0.0, 100, 2, loop == 0 ? 0.0 : 0.7};
    Scene scene = layer(beam);
    const std::vector<std::int64_t> tip = beam.nodes(scene, 0, 100.0, 0.5);
    const std::vector<double> across = beam.along(1);
    const double weight = 1.0;
    std::int64_t obstacle = 0;
    scene.require(delam_mesh_add_obstacle(scene.mesh(), 1, tip.data(), across.data(), &weight, 0, 0, &obstacle),
                  "delam_mesh_add_obstacle");
    scene.begin();
    scene.elastic(-1, 1e4, 0.0);
    scene.contact(0);
    scene.text("kinematics", "corotational");
    for (const double y : {0.0, 0.5, 1.0})
        for (std::size_t axis = 0; axis < 2; ++axis) scene.hold(beam.nodes(scene, 0, 0.0, y), beam.along(axis));
    const auto load = scene.pattern("load", {0.0, 1.0}, {0.0, 66.996});
    scene.hold({0}, beam.along(0));
    scene.drive({0}, across, load, {1.0});
    Solver solver(scene, 0.0);
    for (int k = 1; k <= 40; ++k) {
        solver.step(k / 40.0);
        solver.commit();
    }
    const double force = 4.0 * beams::bending_stiffness(1e4, 1.0) / 1e4;
    cases::expect_near(solver.value("reaction:load"), force, 2e-3, force, "force");
    const std::vector<double> u = solver.field("displacement");
    const auto at = static_cast<std::size_t>(2 * tip.front());
    const std::vector<double> first = beam.along(0);
    cases::expect_near(u[at] * first[0] + u[at + 1] * first[1], -32.894, 1e-3, 32.894, "shortening");
    cases::expect_near(solver.value("stored_bulk"), solver.value("work"), 1e-3, solver.value("work"), "work");
}

// A plane has one normal: a node that slides along another shape would leave it.
TEST(curved_obstacle_is_refused) {
    const Beam beam{10.0, 1.0, 0.0, 10, 1};
    Scene scene = layer(beam);
    const auto face = cases::nodes_where(scene, 0, [](const double* x) { return x[1] < 1e-9; });
    std::vector<double> bent;
    for (std::size_t i = 0; i < face.size(); ++i) {
        const double angle = 0.01 * static_cast<double>(i);
        bent.insert(bent.end(), {std::sin(angle), std::cos(angle)});
    }
    scene.obstacle(face, bent, 0);
    scene.begin();
    scene.elastic(-1, 1e4, 0.0);
    scene.contact(0);
    scene.text("kinematics", "corotational");
    hold_control(scene, 2);
    for (const double y : {0.0, 1.0})
        for (std::size_t axis = 0; axis < 2; ++axis) scene.hold(beam.nodes(scene, 0, 0.0, y), beam.along(axis));
    const std::int32_t status = delam_problem_check(scene.problem());
    const std::string message = delam_context_message(scene.context());
    cases::expect(
        status == DELAM_ERROR_PROBLEM && message.find("not flat, as that of interface 0") != std::string::npos,
        "refused: " + message);
}

}  // namespace
