// SPDX-License-Identifier: BSD-3-Clause
// Faces that press and slide against each other by several cells while they rotate: arms of flexure specimens.
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
using reference::LawData;
using reference::Scene;
using reference::Solver;

constexpr LawData strong{1e5, 1e5, 1e5, 1e5, 1e6, 1e6, 1.0};

// The left support is at the lower face, so that its force reaches the upper arm through the last pairs that touch.
Scene specimen(int dimension, int cells, double w, const char* reduction) {
    Beam beam{100.0, 1.0, 30.0, cells, dimension == 2 ? std::max(1, cells / 100) : 1};
    beam.dimension = dimension;
    if (dimension == 3) beam.width = 2.0;
    Scene scene = beam.mesh();
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, 70e3, 0.0);
    scene.law(0, strong);
    beam.cut(scene);
    scene.text("kinematics", "corotational");
    scene.text("reduction", reduction);
    const auto load = scene.pattern("load", {0.0, 1.0}, {0.0, w});
    scene.hold(beam.nodes(scene, 0, 0.0, 0.0), beam.along(1));
    scene.hold(beam.nodes(scene, 0, 100.0, 0.0), beam.along(0));
    scene.hold(beam.nodes(scene, 0, 100.0, 0.0), beam.along(1));
    beams::drive(scene, beam.nodes(scene, 1, 50.0, 2.0), beam.along(1, -1.0), load);
    if (dimension == 3)
        for (const std::int32_t body : {0, 1})
            scene.hold(cases::nodes_where(scene, body, [](const double* p) { return p[2] < 1e-9; }), beam.along(2));
    return scene;
}

// Returns by how much the faces have slid at most.
double longest_slide(const Solver& solver, int dimension) {
    const std::vector<double> jump = solver.field("jump");
    double longest = 0.0;
    for (std::size_t r = 1; r < jump.size(); r += static_cast<std::size_t>(dimension))
        longest = std::max(longest, std::abs(jump[r]));
    return longest;
}

struct Case {
    int dimension, cells;
    const char* reduction;
};
constexpr std::array<Case, 3> cases_of{{{2, 800, "auto"}, {3, 200, "condensed"}, {3, 200, "iterated"}}};

// Cells much shorter than the slide give the load of those much longer. What reactions work is stored: forces are the
// derivative of the energy while pairs pass others.
LOOP_TEST(arms_slide_by_several_cells, 0, 3) {
    const auto& [dimension, cells, reduction] = cases_of[static_cast<std::size_t>(loop)];
    const int steps = 12;
    const double w = dimension == 2 ? 15.0 : 18.0;
    std::vector<double> load;
    for (const int along : {cells / 4, cells}) {
        Scene scene = specimen(dimension, along, w, reduction);
        scene.text("step_control", "fixed");
        Solver solver(scene, 0.0);
        for (int k = 1; k <= steps; ++k) {
            solver.step(static_cast<double>(k) / steps);
            solver.commit();
        }
        load.push_back(solver.value("reaction:load"));
        const double stored = solver.value("stored_bulk") + solver.value("stored_interface");
        cases::expect_near(solver.value("work"), stored, 1e-3, stored, "work and stored energy");
        cases::expect_below(solver.value("kkt_gap"), 1e-5, "penetration over the largest jump");
        if (along == cells)
            cases::expect_below(dimension == 2 ? 3.5 : 0.8, longest_slide(solver, dimension) * along / 100.0,
                                "the faces slide, in cells");
    }
    cases::expect_near(load[1], load[0], 4e-3, load[0], "load with short cells and with long ones");
}

}  // namespace
