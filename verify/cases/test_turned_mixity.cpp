// SPDX-License-Identifier: BSD-3-Clause
// Bodies that rotate and come apart in mixed mode: what pairs dissipate depends on the loads at which they break, which
// lie within the steps.
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "condensed_scenes.hpp"
#include "rotating_beams.hpp"
#include "support.hpp"

namespace {

using beams::Beam;
using reference::LawData;
using reference::Scene;
using reference::Solver;

// Toughnesses of 100 and 400 J/m2, with strengths of 14 and 28 MPa.
constexpr LawData law{1e5, 1e5, 0.001, 0.004, 0.1, 0.4, 1.5};

struct Case {
    int dimension, cells, across;
    const char* reduction;
};
constexpr Case cases_of[] = {{2, 120, 2, "condensed"}, {2, 40, 1, "iterated"}, {3, 40, 1, "condensed"}};

// Single-leg bending: the upper arm alone rests on the left support.
Scene single_leg(const Case& of, const char* control) {
    const Beam beam{60.0, 2.0, 15.0, of.cells, of.across, 0.0, of.dimension, 1.0};
    Scene scene = beam.mesh();
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, 70e3, 0.3);
    scene.law(0, law);
    beam.cut(scene);
    scene.text("kinematics", "corotational");
    scene.text("reduction", of.reduction);
    scene.text("step_control", control);
    const auto load = scene.pattern("load", {0.0, 1.0}, {0.0, 3.0});
    scene.hold(beam.nodes(scene, 1, 0.0, 2.0), beam.along(1));
    scene.hold(beam.nodes(scene, 0, 60.0, 0.0), beam.along(0));
    scene.hold(beam.nodes(scene, 0, 60.0, 0.0), beam.along(1));
    beams::drive(scene, beam.nodes(scene, 1, 30.0, 4.0), beam.along(1, -1.0), load);
    if (of.dimension == 3)
        for (const std::int32_t body : {0, 1})
            scene.hold(cases::nodes_where(scene, body, [](const double* p) { return p[2] < 1e-9; }), beam.along(2));
    return scene;
}

struct Ended {
    double dissipated, open, rotation;
};

Ended bent(const Case& of, const char* control, int steps) {
    const Scene scene = single_leg(of, control);
    Solver solver(scene, 0.0);
    double released = 0.0;
    for (int k = 1; k <= steps; ++k) {
        solver.step(static_cast<double>(k) / steps);
        solver.commit();
        released += solver.value("released");
    }
    const double dissipated = solver.value("dissipated");
    const double open =
        solver.value("work") - solver.value("stored_bulk") - solver.value("stored_interface") - dissipated - released;
    return {dissipated, open, solver.value("rotation_max")};
}

}  // namespace

// Few steps dissipate what many do, and their energies balance; whole steps record all pairs at the load of the end.
LOOP_TEST(few_steps_dissipate_what_many_do, 0, 3) {
    const Case& of = cases_of[loop];
    const Ended few = bent(of, "auto", 5), many = bent(of, "auto", 12), whole = bent(of, "fixed", 5);
    cases::expect(many.rotation > 0.1, "rotations are large: " + std::to_string(many.rotation));
    cases::expect_near(few.dissipated, many.dissipated, 0.02, many.dissipated, "dissipated in few steps");
    cases::expect_near(few.open, 0.0, 0.02, few.dissipated, "open in few steps");
    cases::expect_near(many.open, 0.0, 0.005, many.dissipated, "open in many steps");
    cases::expect(whole.dissipated > 1.1 * many.dissipated,
                  "whole steps dissipate more: " + std::to_string(whole.dissipated / many.dissipated));
}
