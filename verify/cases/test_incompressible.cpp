// SPDX-License-Identifier: BSD-3-Clause
// Nearly incompressible bodies: a thick-walled cylinder and a bent slab against closed forms; their errors must not
// depend on Poisson's ratio.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "comparison.hpp"
#include "direct.hpp"
#include "support.hpp"

namespace {

using reference::Scene;
using reference::Solver;

std::size_t size(std::int64_t i) { return static_cast<std::size_t>(i); }

struct Case {
    std::int32_t cell;
    std::int64_t nodes;
};
constexpr Case elements[] = {{DELAM_QUAD4, 4}, {DELAM_TRI6, 6},   {DELAM_QUAD8, 8}, {DELAM_QUAD9, 9},
                             {DELAM_HEX8, 8},  {DELAM_TET10, 10}, {DELAM_HEX20, 20}};
constexpr int element_count = 7;
constexpr int flat_count = 4;
bool flat(std::int32_t cell) {
    return cell == DELAM_QUAD4 || cell == DELAM_TRI6 || cell == DELAM_QUAD8 || cell == DELAM_QUAD9;
}

// The block of layers with its nodes moved.
template <class Map>
Scene moved(const Scene& plain, const Case& e, Map&& map) {
    std::int64_t needed = 0;
    std::int64_t count = 0;
    plain.require(delam_mesh_size(plain.mesh(), nullptr, nullptr, &count, nullptr, nullptr), "size");
    std::vector<std::int64_t> offsets(size(count) + 1), cells(size(count * e.nodes));
    std::vector<std::int32_t> types(size(count)), bodies(size(count));
    plain.require(delam_mesh_cells(plain.mesh(), types.data(), bodies.data(), offsets.data(),
                                   static_cast<std::int64_t>(cells.size()), cells.data(), &needed),
                  "cells");
    std::vector<double> nodes = plain.nodes();
    const auto d = size(plain.dimension());
    for (std::size_t n = 0; n < nodes.size(); n += d) map(&nodes[n]);
    return Scene(plain.dimension(), nodes, e.cell, cells, bodies);
}

constexpr double inner = 1.0, outer = 2.0, young = 1e9, push = 1e-3;

// A quarter of a ring (a slice in space) with the inner face pushed outwards: the relative error of the energy, and the
// largest error of sigma_xx + sigma_yy = 4 (lambda + mu) A in the plane at centres, over the pressure.
double cylinder(const Case& e, const char* formulation, double nu, double& stress_error) {
    const double quarter = 0.5 * std::acos(-1.0), slice = 0.3;
    const int d = flat(e.cell) ? 2 : 3;
    const std::int64_t around = 8, through = 2;
    const Scene plain(d, d == 2 ? std::vector<double>{quarter} : std::vector<double>{quarter, slice},
                      d == 2 ? std::vector<std::int64_t>{around} : std::vector<std::int64_t>{around, 1},
                      {0.5 * (outer - inner), 0.5 * (outer - inner)}, {through, through}, e.cell);
    Scene scene = moved(plain, e, [&](double* x) {
        const double r = inner + x[d - 1], s = x[0];
        x[0] = r * std::sin(s);
        x[d - 1] = r * std::cos(s);
    });
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, young, nu);
    scene.require(delam_problem_set_formulation(scene.problem(), -1, formulation), "formulation");
    scene.bonded(0);
    const auto load = scene.pattern("push", {0.0, 1.0}, {0.0, push});
    std::vector<double> low(size(d), -1e-9), high(size(d), 10.0);
    const auto plane = [&](int axis, double at) {
        auto lower = low, upper = high;
        lower[size(axis)] = at - 1e-9;
        upper[size(axis)] = at + 1e-9;
        return scene.find(-1, lower, upper);
    };
    for (std::size_t n = 0; n < scene.node_count(); ++n) {
        const auto node = static_cast<std::int64_t>(n);
        const double x = scene.coordinate(node, 0), y = scene.coordinate(node, d - 1);
        if (std::abs(std::hypot(x, y) - inner) > 1e-9) continue;
        std::vector<double> radial(size(d), 0.0);
        radial[0] = std::abs(x) < 1e-12 ? 0.0 : x;
        radial[size(d - 1)] = std::abs(y) < 1e-12 ? 0.0 : y;
        scene.drive({node}, radial, load, {1.0});
    }
    for (const int axis : {0, d - 1}) {
        std::vector<double> direction(size(d), 0.0);
        direction[size(axis)] = 1.0;
        scene.hold(plane(axis, 0.0), direction);
    }
    if (d == 3) {
        scene.hold(plane(1, 0.0), {0.0, 1.0, 0.0});
        scene.hold(plane(1, slice), {0.0, 1.0, 0.0});
    }
    Solver solver(scene, 0.0);
    solver.step(1.0);
    const double mu = young / (2.0 * (1.0 + nu)), lambda = young * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
    const double share = mu / ((lambda + mu) * outer * outer);  // A = share B
    const double b = push / (share * inner + 1.0 / inner);
    const double pressure = 2.0 * mu * b * (1.0 / (inner * inner) - 1.0 / (outer * outer));
    const double exact = 0.5 * pressure * push * inner * quarter * (d == 2 ? 1.0 : slice);
    const double both = 4.0 * (lambda + mu) * share * b;
    const auto stress = solver.field("stress");
    const std::size_t columns = d == 2 ? 4 : 6, second = d == 2 ? 1 : 2, out = d == 2 ? 2 : 1;
    stress_error = 0.0;
    for (std::size_t i = 0; i < stress.size(); i += columns) {
        const double sum = stress[i] + stress[i + second];
        stress_error =
            std::max({stress_error, std::abs(sum - both) / pressure, std::abs(stress[i + out] - nu * both) / pressure});
    }
    return solver.value("stored_bulk") / exact - 1.0;
}

// A slab of length 10 and height 1 with its ends rotated against each other, plane strain: energy over E/(1 - nu2) I
// kappa2/2 l.
double bending(const Case& e, const char* formulation, double nu, std::int64_t across) {
    const bool plane = flat(e.cell);
    const int d = plane ? 2 : 3;
    const double length = 10.0, kappa = 1e-3, width = 0.5;
    Scene scene(d, plane ? std::vector<double>{length} : std::vector<double>{length, width},
                plane ? std::vector<std::int64_t>{10 * across} : std::vector<std::int64_t>{10 * across, 1}, {0.5, 0.5},
                {across / 2, across / 2}, e.cell);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, young, nu);
    scene.require(delam_problem_set_formulation(scene.problem(), -1, formulation), "formulation");
    scene.bonded(0);
    const auto load = scene.pattern("bend", {0.0, 1.0}, {0.0, kappa});
    for (const std::int64_t node :
         scene.find(-1, std::vector<double>(size(d), -1.0), std::vector<double>(size(d), 11.0))) {
        const double x = scene.coordinate(node, 0), y = scene.coordinate(node, d - 1);
        std::vector<double> along(size(d), 0.0), up(size(d), 0.0);
        along[0] = up[size(d - 1)] = 1.0;
        if (x < 1e-9) scene.hold({node}, along);
        if (x > length - 1e-9) scene.drive({node}, along, load, {-length * (y - 0.5)});
        if (x < 1e-9 && y < 1e-9) scene.hold({node}, up);
        if (d == 3) scene.hold({node}, {0.0, 1.0, 0.0});
    }
    Solver solver(scene, 0.0);
    solver.step(1.0);
    return solver.value("stored_bulk") /
               (0.5 * young / (1.0 - nu * nu) / 12.0 * kappa * kappa * length * (plane ? 1.0 : width)) -
           1.0;
}

constexpr double ratios[] = {0.3, 0.4999, 0.499999};

}  // namespace

// Standard cells lock: quad4 and hex8 by 1e3 at the last ratio, quadratic quadrilaterals by 10.
LOOP_TEST(thick_cylinder, 0, element_count) {
    const Case& e = elements[loop];
    const bool quadratic = e.cell != DELAM_QUAD4 && e.cell != DELAM_HEX8;
    for (const double nu : ratios) {
        double stress = 0.0;
        const std::string where = "nu = " + std::to_string(nu) + ": ";
        cases::expect_near(cylinder(e, "mean-dilatation", nu, stress), 0.0, quadratic ? 6e-5 : 1.2e-3, 1.0,
                           where + "energy");
        cases::expect_below(stress, 0.1, where + "stress");
    }
    double stress = 0.0;
    const double locked = cylinder(e, "standard", ratios[2], stress);
    cases::expect(locked > (e.cell == DELAM_TRI6 ? 1e-3
                            : quadratic          ? 1.0
                                                 : 1e3),
                  "standard cells lock: " + std::to_string(locked));
}

// Linear dilatations represent bending exactly; constant ones are too soft, by an error of second order in the size of
// the cells.
LOOP_TEST(bent_slab, 0, element_count) {
    if (loop == 5 && !cases::whole()) return;  // half of the time of all
    const Case& e = elements[loop];
    const bool exact = e.cell == DELAM_QUAD8 || e.cell == DELAM_QUAD9 || e.cell == DELAM_HEX20;
    double error[3][2];
    for (std::size_t i = 0; i < 3; ++i)
        for (const std::int64_t across : {2, 4})
            error[i][across / 4] = bending(e, "mean-dilatation", ratios[i], across);
    for (std::size_t i = 0; i < 3; ++i) {
        const std::string where = "nu = " + std::to_string(ratios[i]) + ": ";
        if (exact) {
            cases::expect_near(error[i][0], 0.0, 1e-5, 1.0, where + "2 cells");
            cases::expect_near(error[i][1], 0.0, 1e-5, 1.0, where + "4 cells");
            continue;
        }
        cases::expect_near(error[i][0], 0.0, 0.13, 1.0, where + "2 cells");
        cases::expect_near(error[i][1], 0.25 * error[i][0], 0.05, std::abs(error[i][0]), where + "second order");
    }
    if (!exact) cases::expect_near(error[1][1], error[2][1], 1e-3, std::abs(error[2][1]), "nu does not matter");
    if (e.cell == DELAM_QUAD4 || e.cell == DELAM_HEX8)
        cases::expect(bending(e, "standard", ratios[2], 4) > 1e3, "standard cells lock");
}

namespace {

// Everything at once: an inclined ply with a projected dilatation, heated, on an isotropic one.
void mixed(Scene& scene, int d) {
    static const double ply[9] = {135e9, 9e9, 9e9, 0.24, 0.24, 0.46, 5.2e9, 5.2e9, 9e9 / 2.92};
    const double axes[] = {2.0, 1.0, 0.5, 0.0, 1.0, 0.0}, strain[] = {-0.3e-6, 28e-6, 25e-6, 1e-6, 0.0, 2e-6};
    scene.elastic(0, young, 0.4999);
    scene.require(delam_problem_set_orthotropic(scene.problem(), 1, ply), "orthotropic");
    scene.require(delam_problem_set_orientation(scene.problem(), 1, 1, nullptr, axes, 0), "orientation");
    scene.require(delam_problem_set_formulation(scene.problem(), -1, "mean-dilatation"), "formulation");
    scene.law(0, {1e12, 1e12, 100.0, 100.0, 300.0, 300.0});
    std::vector<double> low(size(d), -1.0), high(size(d), 1.0);
    high[0] = 0.0;
    for (int k = 0; k < d; ++k) {
        std::vector<double> direction(size(d), 0.0);
        direction[size(k)] = 1.0;
        scene.hold(scene.find(-1, low, high), direction);
    }
    const auto heat = scene.pattern("heat", {0.0, 1.0}, {0.0, 40.0});
    for (const std::int32_t body : {0, 1})
        scene.require(delam_problem_add_eigenstrain(scene.problem(), heat, body, strain), "eigenstrain");
}

}  // namespace

LOOP_TEST(with_eigenstrain_and_axes, 0, element_count) {
    const Case& e = elements[loop];
    const int d = loop < flat_count ? 2 : 3;
    Scene scene(d, d == 2 ? std::vector<double>{0.04} : std::vector<double>{0.04, 0.01},
                d == 2 ? std::vector<std::int64_t>{6} : std::vector<std::int64_t>{4, 2}, {0.003, 0.004}, {1, 1},
                e.cell);
    scene.interface(0, 1);
    scene.begin();
    mixed(scene, d);
    for (const char* reduction : {"condensed", "iterated", "feti"}) {
        scene.text("reduction", reduction);
        reference::DirectReference direct(scene);
        Solver solver(scene, 0.0);
        solver.equilibrate(1.0, std::vector<double>(scene.pair_count(), 1.0));
        const auto result = reference::compare(solver, direct.solve(1.0, std::vector<double>(scene.pair_count(), 1.0)),
                                               direct.exported(), 1e-6);
        cases::expect_below(result.worst(), 1e-5, std::string(reduction) + ": " + result.text());
        cases::expect(solver.value("stored_bulk") > 0.0, "stored");
    }
    if (d == 3) return;
    scene.require(delam_problem_set_plane(scene.problem(), "plane-stress"), "plane");
    cases::expect(delam_problem_check(scene.problem()) == DELAM_ERROR_PROBLEM, "not in plane stress");
    cases::expect(std::string(delam_context_message(scene.context())).find("no formulation locks") != std::string::npos,
                  "with its reason");
}
