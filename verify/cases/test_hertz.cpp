// SPDX-License-Identifier: BSD-3-Clause
// A cylinder (2D) and a ball (3D) pressed on a layer of ten contact radii, which they touch in one point or not yet:
// H. Hertz, J. reine angew. Math. 92 (1882); K. L. Johnson, Contact Mechanics, 1985, (4.21)-(4.24), (4.43)-(4.45).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "api.hpp"
#include "support.hpp"

namespace {

using reference::Scene;
using reference::Solver;

constexpr double young = 1000.0, poisson = 0.3, radius = 100.0, contact = 2.0;  // contact: its radius, about
constexpr double modulus = young / (2.0 * (1.0 - poisson * poisson));           // E* of two equal bodies

// Places from 0 to `end`: steps of `first` up to `fine`, then growing by `ratio`.
std::vector<double> graded(double first, double fine, double end, double ratio) {
    std::vector<double> x{0.0};
    while (x.back() < fine - 1e-9) x.push_back(x.back() + first);
    for (double step = first * ratio; x.back() < end; step *= ratio) x.push_back(x.back() + step);
    return x;
}

struct Press {
    int d;
    double cells;        // of the layer, over the contact radius
    double upper_cells;  // of the cylinder or ball
    bool upper_is_b;
    double gap;
    const char* reduction;
};

struct Mesh {
    std::vector<double> nodes;
    std::vector<std::int64_t> cells;
    std::vector<std::int32_t> bodies;
};

// Adds a half (2D) or quarter (3D) of the layer (side -1) or of what is pressed on it (side 1).
void add_body(Mesh& mesh, const Press& press, double cells, int side) {
    const double h = contact / cells, ratio = press.d == 2 ? 1.15 : 1.4;
    const auto x = graded(h, 1.4 * contact, 10.0 * contact, ratio), z = graded(h, 0.4 * contact, 10.0 * contact, ratio);
    const auto n = static_cast<std::int64_t>(x.size()), m = press.d == 2 ? std::int64_t{1} : n;
    const auto first = static_cast<std::int64_t>(mesh.nodes.size()) / press.d;
    for (const double depth : z)
        for (std::int64_t j = 0; j < m; ++j)
            for (const double along : x) {
                const double across = press.d == 2 ? 0.0 : x[static_cast<std::size_t>(j)];
                mesh.nodes.push_back(along);
                if (press.d == 3) mesh.nodes.push_back(across);
                const double rise = press.gap + (along * along + across * across) / (2.0 * radius);
                mesh.nodes.push_back(side < 0 ? -depth : rise + depth);
            }
    const auto node = [&](std::int64_t i, std::int64_t j, std::int64_t k) { return first + (k * m + j) * n + i; };
    for (std::int64_t k = 0; k + 1 < static_cast<std::int64_t>(z.size()); ++k)
        for (std::int64_t j = 0; j < std::max<std::int64_t>(1, m - 1); ++j)
            for (std::int64_t i = 0; i + 1 < n; ++i) {
                const std::int64_t low = side < 0 ? k + 1 : k, high = side < 0 ? k : k + 1;
                if (press.d == 2)
                    mesh.cells.insert(mesh.cells.end(),
                                      {node(i, 0, low), node(i + 1, 0, low), node(i + 1, 0, high), node(i, 0, high)});
                else
                    for (const std::int64_t at : {low, high})
                        mesh.cells.insert(mesh.cells.end(), {node(i, j, at), node(i + 1, j, at), node(i + 1, j + 1, at),
                                                             node(i, j + 1, at)});
                mesh.bodies.push_back(side < 0 ? 0 : 1);
            }
}

std::vector<double> axis(int d, int k) {
    std::vector<double> e(static_cast<std::size_t>(d), 0.0);
    e[static_cast<std::size_t>(k)] = 1.0;
    return e;
}

std::vector<std::int64_t> nodes_at(const Scene& scene, std::int32_t body, int k, double x) {
    std::vector<double> lower(static_cast<std::size_t>(scene.dimension()), -1e3), upper(lower.size(), 1e3);
    lower[static_cast<std::size_t>(k)] = x - 1e-9, upper[static_cast<std::size_t>(k)] = x + 1e-9;
    return scene.find(body, lower, upper);
}

Scene scene_of(const Press& press) {
    Mesh mesh;
    add_body(mesh, press, press.cells, -1);
    add_body(mesh, press, press.upper_cells, 1);
    const int d = press.d;
    Scene scene(d, mesh.nodes, d == 2 ? DELAM_QUAD4 : DELAM_HEX8, mesh.cells, mesh.bodies);
    std::int64_t index = -1;
    const double reach = press.gap + 1.5 * contact * contact / radius;
    REQUIRE(scene, delam_mesh_add_mortar_interface, scene.mesh(), press.upper_is_b ? 0 : 1, press.upper_is_b ? 1 : 0,
            reach, &index);
    scene.begin();
    scene.elastic(-1, young, poisson);
    REQUIRE(scene, delam_problem_set_formulation, scene.problem(), -1, "incompatible");
    scene.contact(0);
    const auto gaps = scene.pattern("gaps", {0.0}, {1.0});
    REQUIRE(scene, delam_problem_set_gaps, scene.problem(), 0, gaps, nullptr, 0.0);
    double lowest = 0.0;
    for (std::size_t i = 0; i < scene.nodes().size(); ++i)
        if (i % static_cast<std::size_t>(d) + 1 == static_cast<std::size_t>(d))
            lowest = std::min(lowest, scene.nodes()[i]);
    const auto bottom = nodes_at(scene, 0, d - 1, lowest);
    for (int k = 0; k < d; ++k) scene.hold(bottom, axis(d, k));
    for (int k = 0; k + 1 < d; ++k) {
        std::vector<std::int64_t> plane;
        for (const std::int64_t node : nodes_at(scene, -1, k, 0.0))
            if (std::find(bottom.begin(), bottom.end(), node) == bottom.end()) plane.push_back(node);
        scene.hold(plane, axis(d, k));
    }
    // The top of the upper body, which is a shifted copy of its lower face.
    std::vector<std::int64_t> top;
    for (const std::int64_t node : scene.find(1, std::vector<double>(static_cast<std::size_t>(d), -1e3),
                                              std::vector<double>(static_cast<std::size_t>(d), 1e3))) {
        double rise = press.gap;
        for (int k = 0; k + 1 < d; ++k) rise += scene.coordinate(node, k) * scene.coordinate(node, k) / (2.0 * radius);
        if (scene.coordinate(node, d - 1) - rise >= 10.0 * contact) top.push_back(node);
    }
    const double push = press.gap + (d == 2 ? 2.0 : 1.25) * contact * contact / radius;
    const auto load = scene.pattern("push", {0.0, 1.0}, {0.0, push});
    scene.drive(top, axis(d, d - 1), load, std::vector<double>(top.size(), -1.0));
    scene.text("reduction", press.reduction);
    return scene;
}

struct Errors {
    double peak, radius, total;  // relative
    double force;
};

// Peak and radius of the pressure, whose square is linear in that of the distance from the axis, beside Hertz's.
Errors errors_of(const Press& press) {
    const Scene scene = scene_of(press);
    Solver solver(scene, 0.0);
    solver.step(1.0);
    const int d = press.d;
    const auto rows = static_cast<std::size_t>(d);
    const double parts = d == 2 ? 2.0 : 4.0, force = parts * std::abs(solver.value("reaction:push"));
    const double a = d == 2 ? std::sqrt(4.0 * force * radius / (std::numbers::pi * modulus))
                            : std::cbrt(3.0 * force * radius / (4.0 * modulus));
    const double p0 = d == 2 ? 2.0 * force / (std::numbers::pi * a) : 1.5 * force / (std::numbers::pi * a * a);
    const auto traction = solver.field("traction");
    const auto pairs = scene.pairs(0);
    double sum = 0.0, n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
    for (std::size_t p = 0; p < pairs.count(); ++p) {
        const double pressure = -traction[p * rows];
        double r2 = 0.0;
        for (int k = 0; k + 1 < d; ++k) r2 += std::pow(scene.coordinate(pairs.node_b[p], k), 2);
        sum += parts * pressure * pairs.weight[p];
        if (r2 > 0.7 * 0.7 * a * a) continue;  // where the mesh resolves it
        const double y = pressure * pressure;
        n += 1.0, sx += r2, sy += y, sxx += r2 * r2, sxy += r2 * y;
    }
    const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx), at_axis = (sy - slope * sx) / n;
    const Errors errors{std::sqrt(at_axis) / p0 - 1.0, std::sqrt(-at_axis / slope) / a - 1.0, sum / force - 1.0, force};
    std::printf("%dD, %g and %g cells, b %s, gap %g, %s: a %.3f, p0 %+.2f %%, a %+.2f %%, %g displacements\n", d,
                press.cells, press.upper_cells, press.upper_is_b ? "above" : "below", press.gap, press.reduction, a,
                100.0 * errors.peak, 100.0 * errors.radius, static_cast<double>(scene.nodes().size()));
    cases::expect_near(solver.value("work"), solver.value("stored_bulk"), 5e-3, solver.value("stored_bulk"),
                       "work is stored");
    return errors;
}

void expect_hertz(const Press& press, double tolerance) {
    const Errors errors = errors_of(press);
    cases::expect_below(std::abs(errors.peak), tolerance, "peak pressure");
    cases::expect_below(std::abs(errors.radius), tolerance, "contact radius");
    cases::expect_below(std::abs(errors.total), 2e-3, "the pressure carries the force");
}

TEST(cylinder) {
    for (const double upper : {12.0, 9.0, 16.0})
        for (const bool above : {true, false}) expect_hertz({2, 12.0, upper, above, 0.0, "condensed"}, 0.02);
    for (const char* reduction : {"condensed", "iterated", "feti"})
        expect_hertz({2, 12.0, 9.0, true, 0.05, reduction}, 0.02);
}

// 12 cells over the radius in the long tier.
TEST(ball) {
    const double cells = cases::whole() ? 12.0 : 4.0;
    for (const bool above : {true, false})
        expect_hertz({3, cells, 0.8 * cells, above, above ? 0.0 : 0.05, "iterated"}, cases::whole() ? 0.02 : 0.05);
}

}  // namespace
