// SPDX-License-Identifier: BSD-3-Clause
// Interfaces of all cell types on meshes of very few faces: a uniform opening is exact, the energy of an opening that
// varies over the faces is that of the rule of the pairs in closed form, and cracks of quadratic cells grow at the
// loads of fine linear ones.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "acceptance.hpp"
#include "support.hpp"

namespace {

using reference::Scene;
using reference::Solver;

struct Shape {
    int dimension;
    std::int32_t cell;
    const char* name;
    // Pairs store more energy in a linear opening of n x n faces than the continuum, by this over n^2.
    double excess;
};
constexpr Shape shapes[] = {
    {2, DELAM_TRI3, "tri3", 0.5},        {2, DELAM_QUAD4, "quad4", 0.5},     {2, DELAM_TRI6, "tri6", 0.0},
    {2, DELAM_QUAD8, "quad8", 0.0},      {2, DELAM_QUAD9, "quad9", 0.0},     {3, DELAM_TET4, "tet4", 0.5},
    {3, DELAM_HEX8, "hex8", 0.5},        {3, DELAM_WEDGE6, "wedge6", 0.5},   {3, DELAM_PYRAMID5, "pyramid5", 0.5},
    {3, DELAM_TET10, "tet10", 1.0 / 10}, {3, DELAM_HEX20, "hex20", 1.0 / 6}, {3, DELAM_WEDGE15, "wedge15", 1.0 / 10},
    {3, DELAM_HEX27, "hex27", 0.0}};
constexpr int shape_count = static_cast<int>(std::size(shapes));
constexpr double stiffness = 1e12;

std::vector<double> axis(int dimension, int k) {
    std::vector<double> direction(static_cast<std::size_t>(dimension), 0.0);
    direction[static_cast<std::size_t>(k)] = 1.0;
    return direction;
}

// Two blocks with unit faces, of height 1/2 each.
Scene blocks(const Shape& shape, std::int64_t n, double young, double poisson) {
    const std::size_t flat = static_cast<std::size_t>(shape.dimension) - 1;
    Scene scene(shape.dimension, std::vector<double>(flat, 1.0), std::vector<std::int64_t>(flat, n), {0.5, 0.5}, {1, 1},
                shape.cell);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, young, poisson);
    if (shape.dimension == 2) scene.require(delam_problem_set_plane(scene.problem(), "plane-stress"), "plane");
    scene.law(0, {stiffness, stiffness, 1e30, 1e30, 2e30, 2e30});
    return scene;
}

std::vector<std::int64_t> level(const Scene& scene, double height) {
    std::vector<double> low(static_cast<std::size_t>(scene.dimension()), -1.0), high(low.size(), 2.0);
    low.back() = high.back() = height;
    return scene.find(-1, low, high);
}

LOOP_TEST(uniform_opening, 0, shape_count) {
    const Shape& shape = shapes[loop];
    const double young = 1e12, w = 1e-3;
    for (const std::int64_t n : {1, 2, 4}) {
        Scene scene = blocks(shape, n, young, 0.3);
        const int d = shape.dimension;
        const auto load = scene.pattern("pull", {0.0, 1.0}, {0.0, w});
        const auto top = level(scene, 1.0);
        scene.hold(level(scene, 0.0), axis(d, d - 1));
        scene.drive(top, axis(d, d - 1), load, std::vector<double>(top.size(), 1.0));
        for (const double height : {0.0, 1.0}) {
            std::vector<double> corner(static_cast<std::size_t>(d), 0.0);
            corner.back() = height;
            for (int k = 0; k + 1 < d; ++k) scene.hold(scene.find(-1, corner, corner), axis(d, k));
            corner[0] = 1.0;
            if (d == 3) scene.hold(scene.find(-1, corner, corner), axis(d, 1));
        }
        Solver solver(scene, 0.0);
        solver.equilibrate(1.0, {});
        const double traction = w / (1.0 / young + 1.0 / stiffness);
        const std::string where = std::string(shape.name) + ", " + std::to_string(n) + " faces along a side: ";
        const auto jump = solver.field("jump");
        for (std::size_t i = 0; i < jump.size(); ++i)
            cases::expect_near(jump[i], i % static_cast<std::size_t>(d) == 0 ? traction / stiffness : 0.0, 1e-10,
                               traction / stiffness, where + "jump");
        cases::expect_near(solver.value("reaction:pull"), traction, 1e-10, traction, where + "reaction");
    }
}

// Blocks that are all but rigid, the upper one turned about the edge x = 0 of the interface.
LOOP_TEST(linear_opening, 0, shape_count) {
    const Shape& shape = shapes[loop];
    const double angle = 1e-3;
    for (const std::int64_t n : {1, 2, 4}) {
        Scene scene = blocks(shape, n, 1e7 * stiffness, 0.0);
        const int d = shape.dimension;
        const auto load = scene.pattern("turn", {0.0, 1.0}, {0.0, angle});
        for (int k = 0; k < d; ++k) scene.hold(level(scene, 0.0), axis(d, k));
        const auto top = level(scene, 1.0);
        std::vector<double> rise, back(top.size(), -0.5);
        for (const std::int64_t node : top) rise.push_back(scene.coordinate(node, 0));
        scene.drive(top, axis(d, d - 1), load, rise);
        scene.drive(top, axis(d, 0), load, back);
        if (d == 3) scene.hold(top, axis(d, 1));
        Solver solver(scene, 0.0);
        solver.equilibrate(1.0, {});
        const double exact = 0.5 * stiffness * angle * angle / 3.0;
        cases::expect_near(solver.value("stored_interface") / exact - 1.0, shape.excess / static_cast<double>(n * n),
                           1e-5, 1.0, std::string(shape.name) + ", " + std::to_string(n) + " faces along a side");
    }
}

// A double cantilever beam (pulled) or an end-notched flexure specimen (pressed) without lateral motions. Returns the
// peak of the load per width.
double peak_load(std::int32_t cell, double h, bool flexure) {
    const bool plane = cell == DELAM_QUAD4;
    const int d = plane ? 2 : 3, up = d - 1;
    const double length = flexure ? 60e-3 : 40e-3, notch = 16e-3, arm = 1.5e-3;
    const auto along = static_cast<std::int64_t>(std::lround(length / h));
    const auto through = std::max<std::int64_t>(1, std::lround(0.5 * arm / h));
    Scene scene = plane ? Scene(2, {length}, {along}, {arm, arm}, {through, through}, cell)
                        : Scene(3, {length, h}, {along, 1}, {arm, arm}, {through, through}, cell);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, 70e9, 0.0);
    const double onset = 0.5 * 4e6 * 4e6 / 2e13;
    scene.law(0, {2e13, 2e13, onset, onset, 300.0, 300.0});
    const reference::Pairs pairs = scene.pairs(0);
    std::vector<std::int64_t> open;
    for (std::size_t p = 0; p < pairs.count(); ++p)
        if (scene.coordinate(pairs.node_b[p], 0) < notch - 1e-9) open.push_back(static_cast<std::int64_t>(p));
    scene.adhesion(0, open, std::vector<double>(open.size(), 0.0));
    const auto line = [&](double x, double z) {
        return plane ? scene.find(-1, {x, z}, {x, z}) : scene.find(-1, {x, 0.0, z}, {x, h, z});
    };
    for (int k = 1; k < up; ++k) scene.hold(scene.find(-1, {-1, -1, -1}, {1, 1, 1}), axis(3, k));
    const auto load = scene.pattern("load", {0.0, 1.0}, {0.0, flexure ? 2.2e-3 : 2.4e-3});
    if (flexure) {
        scene.hold(line(0.0, 0.0), axis(d, up));
        scene.hold(line(length, 0.0), axis(d, up));
        scene.hold(line(length, 0.0), axis(d, 0));
        const auto nose = line(0.5 * length, 2.0 * arm);
        scene.drive(nose, axis(d, up), load, std::vector<double>(nose.size(), -1.0));
    } else {
        for (const double side : {-0.5, 0.5}) {
            const auto end = line(0.0, side < 0.0 ? 0.0 : 2.0 * arm);
            scene.drive(end, axis(d, up), load, std::vector<double>(end.size(), side));
        }
        std::vector<double> low(static_cast<std::size_t>(d), -1.0), high(low.size(), 1.0);
        low[0] = length;
        scene.hold(scene.find(-1, low, high), axis(d, 0));
        scene.hold(line(length, 0.0), axis(d, up));
    }
    Solver solver(scene, 0.0);
    double peak = 0.0;
    constexpr int steps = 40;
    for (int k = 1; k <= steps; ++k) {
        solver.step(static_cast<double>(k) / steps);
        solver.commit();
        peak = std::max(peak, std::abs(solver.value("reaction:load")) / (plane ? 1.0 : h));
    }
    return peak;
}

LOOP_TEST(peaks_are_those_of_fine_linear_cells, 0, 2) {
    const bool flexure = loop == 1;
    const double fine = peak_load(DELAM_QUAD4, 0.25e-3, flexure);
    for (const auto& [cell, name] :
         {std::pair{DELAM_TET10, "tet10"}, {DELAM_HEX20, "hex20"}, {DELAM_WEDGE15, "wedge15"}}) {
        const double coarse = peak_load(cell, 1e-3, flexure);
        std::printf("%s, %s of 1 mm: peak %.4f of that of quad4 of 0.25 mm\n", flexure ? "flexure" : "cantilevers",
                    name, coarse / fine);
        cases::expect_near(coarse, fine, 0.02, fine, std::string(name) + ": peak");
    }
}

}  // namespace
