// SPDX-License-Identifier: BSD-3-Clause
// A slab in space whose sides cannot move sideways is a plane-strain strip: one cell of hex8 across the width gives the
// same analysis as quad4, pair for pair; mixed-mode flexure (contact behind the tip) and a double cantilever beam.
#include <cmath>
#include <vector>

#include "api.hpp"
#include "support.hpp"

namespace {

using cases::expect;
using cases::expect_near;
using reference::Scene;
using reference::Solver;

constexpr double length = 0.120, arm = 3e-3, width = 0.7e-3, notch = 0.030;
constexpr std::int64_t along = 60;

struct Specimen {
    bool beam;  // double cantilever beam, else mixed-mode flexure
    bool incompatible;
    const char* rule;  // of the mixity
    const char* control = "fixed";
};

Scene make(const Specimen& specimen, int dimension) {
    const bool solid = dimension == 3;
    Scene scene(dimension, solid ? std::vector<double>{length, width} : std::vector<double>{length},
                solid ? std::vector<std::int64_t>{along, 1} : std::vector<std::int64_t>{along}, {arm, arm}, {2, 2},
                solid ? DELAM_HEX8 : DELAM_QUAD4);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, 75e9, 0.3);
    if (specimen.incompatible) REQUIRE(scene, delam_problem_set_formulation, scene.problem(), -1, "incompatible");
    scene.law(0, {125e9, 250e9, 100.0, 120.0, 250.0, 400.0});
    const reference::Pairs pairs = scene.pairs(0);
    std::vector<std::int64_t> open;
    for (std::size_t p = 0; p < pairs.count(); ++p)
        if (scene.coordinate(pairs.node_a[p], 0) < notch - 1e-6) open.push_back(static_cast<std::int64_t>(p));
    scene.adhesion(0, open, std::vector<double>(open.size(), 0.0));

    // The line (2D: point) at x and the height z.
    const auto line = [&](std::int32_t body, double x, double z) {
        return solid ? scene.find(body, {x, 0.0, z}, {x, width, z}) : scene.find(body, {x, z}, {x, z});
    };
    const std::vector<double> lengthwise = solid ? std::vector<double>{1, 0, 0} : std::vector<double>{1, 0};
    const std::vector<double> upwards = solid ? std::vector<double>{0, 0, 1} : std::vector<double>{0, 1};
    if (solid) scene.hold(scene.find(-1, {-1, -1, -1}, {1, 1, 1}), {0, 1, 0});
    const auto load = scene.pattern("load", {0.0, 1.0}, {0.0, specimen.beam ? 4e-3 : 6e-3});
    const auto drive = [&](const std::vector<std::int64_t>& nodes, double sign) {
        scene.drive(nodes, upwards, load, std::vector<double>(nodes.size(), sign));
    };
    if (specimen.beam) {
        drive(line(1, 0.0, arm), 1.0);
        drive(line(0, 0.0, arm), -1.0);
        scene.hold(line(0, length, 0.0), lengthwise);
        scene.hold(line(0, length, 0.0), upwards);
    } else {
        scene.hold(line(1, 0.0, arm), upwards);
        scene.hold(line(0, length, 0.0), lengthwise);
        scene.hold(line(0, length, 0.0), upwards);
        drive(line(1, 0.5 * length, 2.0 * arm), -1.0);
    }
    scene.text("mixity_rule", specimen.rule);
    scene.text("step_control", specimen.control);
    scene.number("damage_tolerance", 1e-10);
    return scene;
}

LOOP_TEST(a_slab_is_plane_strain, 0, 12) {
    const bool frozen = loop < 4;
    const Specimen specimen{loop % 2 == 1, loop / 2 % 2 == 1, frozen ? "frozen" : "converged",
                            loop < 8 ? "fixed" : "load"};
    const Scene plane = make(specimen, 2), solid = make(specimen, 3);
    Solver flat(plane, 0.0), slab(solid, 0.0);
    double in_plane = 0.0, in_space = 0.0;
    for (int k = 1; k <= 10; ++k) {
        flat.step(0.1 * k);
        slab.step(0.1 * k);
        flat.commit();
        slab.commit();
        // The prescribed sideways jumps exclude no pair from Newton's method (plain steps: more than a hundred).
        if (frozen) cases::expect_below(slab.value("am_iterations"), 10.0, "alternations of the slab");
        in_plane += flat.value("am_iterations");
        in_space += slab.value("am_iterations");
        for (const char* key : {"reaction:load", "stored_bulk", "stored_interface", "dissipated"}) {
            const double scale = std::max(std::abs(flat.value(key)), 1e-3 * flat.value("work"));
            expect_near(slab.value(key) / width, flat.value(key), 1e-7, scale, key);
        }
        // Pairs are ordered by x first: two across the width for each of the strip.
        const std::vector<double> flat_zeta = flat.field("adhesion"), slab_zeta = slab.field("adhesion");
        expect(slab_zeta.size() == 2 * flat_zeta.size(), "pairs");
        for (std::size_t p = 0; p < slab_zeta.size(); ++p)
            expect_near(slab_zeta[p], flat_zeta[p / 2], 1e-7, 1.0, "adhesion");
    }
    // Steps that are followed in parts have as many of them in space.
    cases::expect_below(in_space, 2.0 * in_plane + 10.0, "alternations of the slab's analysis");
    expect(flat.value("dissipated") > 0.0 && flat.value("process_zone") > 0.0, "something was damaged");
}

}  // namespace
