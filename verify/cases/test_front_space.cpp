// SPDX-License-Identifier: BSD-3-Clause
// Fronts in space that grow: the energy release rate of every point and what growth dissipates per area are the
// toughness, on straight fronts and a circular one (of other types of cells: test_long_front_space); a slab has the
// rates of the strip in the plane.
#include "growing_fronts.hpp"

#include "support.hpp"

using namespace growing_fronts;

LOOP_TEST(straight_front_grows, 0, 3) { grow_straight(straight_kinds[loop]); }

TEST(circular_front_grows) { grow_circular(circular_kinds[1]); }

// One arm is pulled, so that the front grows in mixed mode: one cell of hex20 across the width against quad8.
TEST(slab_of_quadratic_cells) {
    const double length = 60e-3, width = 1e-3, arm = 2e-3, end = 2.5e-3;
    double load[2] = {0, 0}, rate[2] = {0, 0}, mixity[2] = {0, 0}, area[2] = {0, 0};
    for (const int d : {2, 3}) {
        const bool solid = d == 3;
        reference::Scene scene(d, solid ? std::vector<double>{length, width} : std::vector<double>{length},
                               solid ? std::vector<std::int64_t>{60, 1} : std::vector<std::int64_t>{60}, {arm, arm},
                               {2, 2}, solid ? DELAM_HEX20 : DELAM_QUAD8);
        scene.interface(0, 1);
        scene.begin();
        scene.elastic(-1, young, 0.3);
        scene.law(0, {1e14, 1e14, 1.125, 1.125, gc, gc, 1.0});
        open(scene, 15e-3, false);
        const auto line = [&](std::int32_t body, double x, double low, double high) {
            return solid ? scene.find(body, {x, 0.0, low}, {x, width, high}) : scene.find(body, {x, low}, {x, high});
        };
        const auto axis = [&](int k) {
            std::vector<double> direction(static_cast<std::size_t>(d), 0.0);
            direction[static_cast<std::size_t>(k)] = 1.0;
            return direction;
        };
        if (solid) scene.hold(scene.find(-1, {-1, -1, -1}, {1, 1, 1}), axis(1));
        for (const int k : {0, d - 1}) scene.hold(line(-1, length, 0.0, 2.0 * arm), axis(k));
        const auto pull = scene.pattern("pull", {0.0, 1.0}, {0.0, end});
        const auto nodes = line(1, 0.0, 2.0 * arm, 2.0 * arm);
        scene.drive(nodes, axis(d - 1), pull, std::vector<double>(nodes.size(), 1.0));
        scene.text("mixity_rule", "frozen");
        reference::Solver solver(scene, 0.0);
        for (int k = 1; k <= 16; ++k) {
            solver.step(k / 16.0);
            solver.commit();
        }
        const std::size_t i = solid ? 1 : 0;
        load[i] = solver.value("reaction:pull") / (solid ? width : 1.0);
        rate[i] = solver.value("energy_release_rate");
        mixity[i] = solver.value("front_mixity");
        area[i] = solver.value("crack_area") / (solid ? width : 1.0);
    }
    std::printf(
        "slab of hex20 / strip of quad8: load %.4f, G %.4f (%.4g J/m2), crack %.4f (%.4g mm), mixity %.3f, %.3f\n",
        load[1] / load[0], rate[1] / rate[0], rate[0], area[1] / area[0], 1e3 * area[0], mixity[1], mixity[0]);
    expect(area[0] > 20e-3, "it has grown");
    expect_near(load[1], load[0], 0.01, load[0], "load");
    expect_near(rate[1], rate[0], 0.03, rate[0], "largest rate of the slab");
    expect_near(mixity[1], mixity[0], 0.01, 1.0, "mixity");
    expect_near(area[1], area[0], 0.01, area[0], "length of the crack");
}
