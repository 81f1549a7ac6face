// SPDX-License-Identifier: BSD-3-Clause
// Mirror-symmetric scenes have mirror-symmetric solutions, and solutions do not depend on the units.
#include <algorithm>

#include "api.hpp"
#include "support.hpp"

namespace {

using reference::LawData;
using reference::Scene;
using reference::Solver;

double largest(const std::vector<double>& values) {
    double size = 0.0;
    for (const double v : values) size = std::max(size, std::abs(v));
    return size;
}

constexpr double length = 0.04;
constexpr double arm = 2e-3;
constexpr int columns = 40;
// Tight enough that the stopping test of the minimisation does not affect the comparison.
constexpr double damage_tolerance = 1e-11;
constexpr double symmetric_to = 1e-8;

// Two arms bonded over their length except for pairs with low <= x <= high.
Scene arms(double low, double high) {
    Scene scene(2, {length}, {columns}, {arm, arm}, {2, 2}, DELAM_QUAD4);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, 70e9, 0.3);
    scene.law(0, {1e13, 1e13, 50.0, 80.0, 200.0, 400.0});
    std::vector<std::int64_t> notch;
    const auto a = scene.pairs(0).node_a;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double x = scene.coordinate(a[i], 0);
        if (x >= low && x <= high) notch.push_back(static_cast<std::int64_t>(i));
    }
    scene.adhesion(0, notch, std::vector<double>(notch.size(), 0.0));
    scene.number("damage_tolerance", damage_tolerance);
    return scene;
}

// A crack in the middle, opened at mid-span: left and right respond alike.
TEST(left_and_right) {
    Scene scene = arms(0.4 * length, 0.6 * length);
    const auto bottom = scene.find(0, {0.0, 0.0}, {length, 0.0});
    scene.hold(bottom, {0.0, 1.0});
    scene.hold(scene.find(0, {0.5 * length, 0.0}, {0.5 * length, 0.0}), {1.0, 0.0});
    const auto middle = scene.find(1, {0.5 * length, 2 * arm}, {0.5 * length, 2 * arm});
    scene.drive(middle, {0.0, 1.0}, scene.pattern("lift", {0.0, 1.0}, {0.0, 3e-5}), {1.0});
    scene.number("subdomains", 5);
    Solver solver(scene, 0.0);
    for (int k = 1; k <= 6; ++k) {
        solver.step(k / 6.0);
        solver.commit();
        const std::string where = "step " + std::to_string(k) + ": ";
        const auto adhesion = solver.field("adhesion");
        const auto jump = solver.field("jump");
        const auto traction = solver.field("traction");
        const std::size_t n = adhesion.size();
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t m = n - 1 - i;
            cases::expect_near(adhesion[i], adhesion[m], symmetric_to, 1.0, where + "adhesion");
            cases::expect_near(jump[2 * i], jump[2 * m], symmetric_to, largest(jump), where + "opening");
            cases::expect_near(jump[2 * i + 1], -jump[2 * m + 1], symmetric_to, largest(jump), where + "slip");
            cases::expect_near(traction[2 * i], traction[2 * m], symmetric_to, largest(traction),
                               where + "normal traction");
            cases::expect_near(traction[2 * i + 1], -traction[2 * m + 1], symmetric_to, largest(traction),
                               where + "shear");
        }
    }
    cases::expect(solver.value("dissipated") > 0.0, "the crack grows, or nothing was tested");
}

// A double cantilever opened by equal and opposite displacements: no slip, and the arms are mirror images.
TEST(upper_and_lower) {
    Scene scene = arms(0.0, 0.3 * length);
    const auto right = scene.find(-1, {length, 0.0}, {length, 2 * arm});
    scene.hold(right, {1.0, 0.0});
    scene.hold(right, {0.0, 1.0});
    const auto load = scene.pattern("open", {0.0, 1.0}, {0.0, 1e-3});
    scene.drive(scene.find(1, {0.0, 2 * arm}, {0.0, 2 * arm}), {0.0, 1.0}, load, {0.5});
    scene.drive(scene.find(0, {0.0, 0.0}, {0.0, 0.0}), {0.0, -1.0}, load, {0.5});
    scene.number("subdomains", 5);
    Solver solver(scene, 0.0);
    for (int k = 1; k <= 6; ++k) {
        solver.step(k / 6.0);
        solver.commit();
        const std::string where = "step " + std::to_string(k) + ": ";
        const auto jump = solver.field("jump");
        for (std::size_t i = 1; i < jump.size(); i += 2)
            cases::expect_near(jump[i], 0.0, symmetric_to, largest(jump), where + "slip");
        const auto u = solver.field("displacement");
        for (int i = 0; i <= columns; ++i) {
            const double x = length * i / columns;
            const auto low = scene.find(0, {x, 0.0}, {x, 0.0}).at(0);
            const auto high = scene.find(1, {x, 2 * arm}, {x, 2 * arm}).at(0);
            const auto at = [&](std::int64_t node, int c) { return u[static_cast<std::size_t>(2 * node + c)]; };
            cases::expect_near(at(high, 0), at(low, 0), symmetric_to, largest(u), where + "along");
            cases::expect_near(at(high, 1), -at(low, 1), symmetric_to, largest(u), where + "across");
        }
    }
    cases::expect(solver.value("dissipated") > 0.0, "the crack grows, or nothing was tested");
}

// Mixed-mode bending of a cantilever in units that multiply every length by `a` and every force by `b`.
struct Record {
    std::vector<double> jump, traction, adhesion, displacement;
    double stored, dissipated, work, reaction;
};

Record bending(double a, double b) {
    Scene scene(2, {length * a}, {columns}, {arm * a, arm * a}, {2, 2}, DELAM_QUAD4);
    scene.interface(0, 1);
    scene.begin();
    const double stress = b / (a * a);
    scene.elastic(-1, 70e9 * stress, 0.3);
    const double g = stress * a;
    scene.law(0, {1e13 * stress / a, 2e13 * stress / a, 50.0 * g, 80.0 * g, 200.0 * g, 400.0 * g});
    std::vector<std::int64_t> notch;
    for (std::int64_t i = 0; i < 12; ++i) notch.push_back(i);
    scene.adhesion(0, notch, std::vector<double>(notch.size(), 0.0));
    const auto right = scene.find(-1, {length * a, 0.0}, {length * a, 2 * arm * a});
    scene.hold(right, {1.0, 0.0});
    scene.hold(right, {0.0, 1.0});
    const auto load = scene.pattern("lift", {0.0, 1.0}, {0.0, 1.5e-3 * a});
    scene.drive(scene.find(1, {0.0, 2 * arm * a}, {0.0, 2 * arm * a}), {0.0, 1.0}, load, {1.0});
    scene.number("subdomains", 4);
    scene.number("damage_tolerance", damage_tolerance);
    Solver solver(scene, 0.0);
    for (int k = 1; k <= 4; ++k) {
        solver.step(k / 4.0);
        solver.commit();
    }
    return {solver.field("jump"),
            solver.field("traction"),
            solver.field("adhesion"),
            solver.field("displacement"),
            solver.value("stored_bulk") + solver.value("stored_interface"),
            solver.value("dissipated"),
            solver.value("work"),
            solver.value("reaction:lift")};
}

void expect_scaled(const std::vector<double>& values, const std::vector<double>& base, double factor, double tolerance,
                   const std::string& what) {
    const double size = largest(base) * factor;
    for (std::size_t i = 0; i < base.size(); ++i)
        cases::expect_near(values[i], base[i] * factor, tolerance, size, what);
}

struct Units {
    double length, force, tolerance;
    const char* name;
};
constexpr Units systems[] = {
    {1024.0, 1.0, 1e-12, "length 2^10"},  {1.0, 1.0 / 4096.0, 1e-12, "force 2^-12"},
    {0.125, 64.0, 1e-12, "2^-3 and 2^6"}, {1e3, 1.0, 1e-9, "mm, N"},
    {1e6, 1e6, 1e-9, "um, uN"},           {1.0 / 0.0254, 1.0 / 4.4482216152605, 1e-9, "inch, pound"}};

LOOP_TEST(change_of_units, 0, 6) {
    const Units& s = systems[loop];
    const Record base = bending(1.0, 1.0);
    const Record other = bending(s.length, s.force);
    cases::expect(base.dissipated > 0.0, "the interface is damaged, or nothing was tested");
    const std::string where = std::string(s.name) + ": ";
    const double energy = s.force * s.length;
    // Forces and energies of the plane are per unit thickness, which is a length too.
    expect_scaled(other.adhesion, base.adhesion, 1.0, s.tolerance, where + "adhesion");
    expect_scaled(other.jump, base.jump, s.length, s.tolerance, where + "jump");
    expect_scaled(other.displacement, base.displacement, s.length, s.tolerance, where + "displacement");
    expect_scaled(other.traction, base.traction, s.force / (s.length * s.length), s.tolerance, where + "traction");
    const double per_thickness = 1.0 / s.length;
    cases::expect_near(other.stored, base.stored * energy * per_thickness, s.tolerance,
                       base.work * energy * per_thickness, where + "stored");
    cases::expect_near(other.dissipated, base.dissipated * energy * per_thickness, s.tolerance,
                       base.work * energy * per_thickness, where + "dissipated");
    cases::expect_near(other.work, base.work * energy * per_thickness, s.tolerance, base.work * energy * per_thickness,
                       where + "work");
    const double force = s.force * per_thickness;
    cases::expect_near(other.reaction, base.reaction * force, s.tolerance, std::abs(base.reaction) * force,
                       where + "reaction");
}

}  // namespace
