// SPDX-License-Identifier: BSD-3-Clause
// Loads of any size that a double holds, on every realisation of the jump operator: a step that ends with DELAM_OK is
// finite and meets its supports; where its energies have no finite number, the step says so and leaves nothing behind.
// While nothing is damaged, everything is proportional to the load.
#include <algorithm>
#include <cmath>

#include "enf.hpp"
#include "support.hpp"

namespace {

using reference::Scene;
using reference::Solver;

struct Way {
    const char* reduction;
    const char* preconditioner = "series";
    const char* gluing = "orthonormal";
    const char* minimisation = "auto";
    const char* rule = "frozen";
    std::string text() const {
        return std::string(reduction) + ", " + preconditioner + ", " + gluing + ", " + minimisation + ", " + rule;
    }
};

constexpr Way ways[] = {{"condensed"},
                        {"condensed", "series", "orthonormal", "alternate"},
                        {"iterated"},
                        {"feti"},
                        {"feti", "none", "orthonormal", "alternate"},
                        {"feti", "lumped", "redundant"},
                        {"feti", "dirichlet", "redundant", "auto", "converged"},
                        {"condensed", "series", "orthonormal", "auto", "converged"},
                        {"feti", "lumped", "redundant", "alternate", "converged"}};
constexpr int way_count = sizeof ways / sizeof ways[0];

// The flexure, pressed by `size` at time 1 and by size * fraction at time 2. in_pattern: the size is in the drive's
// coefficients, and the factor is 1; otherwise the other way round.
Scene flexure(const Way& way, double size, bool in_pattern, double fraction = 1.0) {
    constexpr double h = 3e-3;
    Scene scene(2, {cases::enf_length}, {40}, {cases::enf_arm, cases::enf_arm}, {1, 1}, DELAM_QUAD4);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, 75e9, 0.3);
    scene.law(0, {125e9, 125e9, 100.0, 150.0, 250.0, 400.0});
    const std::vector<double> x = cases::enf_positions(scene);
    std::vector<std::int64_t> notch;
    for (std::size_t i = 0; i < x.size(); ++i)
        if (x[i] < cases::enf_notch - 0.25 * h) notch.push_back(static_cast<std::int64_t>(i));
    scene.adhesion(0, notch, std::vector<double>(notch.size(), 0.0));
    scene.hold(scene.find(0, {0.0, 0.0}, {0.0, 0.0}), {0.0, 1.0});
    const auto right = scene.find(0, {cases::enf_length, 0.0}, {cases::enf_length, 0.0});
    scene.hold(right, {1.0, 0.0});
    scene.hold(right, {0.0, 1.0});
    const double factor = in_pattern ? 1.0 : size;
    const auto press = scene.pattern("press", {0.0, 1.0, 2.0}, {0.0, factor, factor * fraction});
    const double top = 2.0 * cases::enf_arm, middle = 0.5 * cases::enf_length;
    scene.drive(scene.find(1, {middle, top}, {middle, top}), {0.0, -1.0}, press, {in_pattern ? size : 1.0});
    scene.text("reduction", way.reduction);
    scene.text("preconditioner", way.preconditioner);
    scene.text("gluing", way.gluing);
    scene.text("minimisation", way.minimisation);
    scene.text("mixity_rule", way.rule);
    if (std::string(way.reduction) == "feti") scene.number("subdomains", 4);
    return scene;
}

// loose: the upper arm has come off and may slide, so that nothing tells when it buckles.
void expect_finite(const Solver& solver, const std::string& where, bool loose = false) {
    const std::vector<double> values = solver.values();
    const bool stored = solver.value("stored_bulk") > 0.0;  // squares of tiny loads are 0
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::string name = delam_solver_value_name(solver.get(), static_cast<std::int64_t>(i));
        const bool of_nothing = name.rfind("mesh_", 0) == 0 && !stored;  // parts of an energy of 0
        if (loose && name == "buckling_ratio") continue;
        cases::expect(std::isfinite(values[i]) != of_nothing, where + ": value '" + name + "' is not finite");
    }
    for (const char* key : {"displacement", "jump", "traction", "adhesion", "mixity", "reaction"})
        for (const double v : solver.field(key)) cases::expect(std::isfinite(v), where + ": " + key + " is not finite");
}

void expect_held(const Scene& scene, const Solver& solver, double size, const std::string& where) {
    const std::vector<double> u = solver.field("displacement");
    const auto at = [&](double x, double y, int axis) {
        const std::int64_t node = scene.find(y == 0.0 ? 0 : 1, {x, y}, {x, y}).front();
        return u[static_cast<std::size_t>(2 * node + axis)];
    };
    cases::expect_near(at(0.0, 0.0, 1), 0.0, 1e-6, size, where + ": left support");
    cases::expect_near(at(cases::enf_length, 0.0, 0), 0.0, 1e-6, size, where + ": right support, along");
    cases::expect_near(at(cases::enf_length, 0.0, 1), 0.0, 1e-6, size, where + ": right support, across");
    cases::expect_near(at(0.5 * cases::enf_length, 2.0 * cases::enf_arm, 1), -size, 1e-6, size, where + ": load");
}

std::string where(const Way& way, double size) {
    char text[40];
    std::snprintf(text, sizeof text, " at %.3g m", size);
    return way.text() + text;
}

LOOP_TEST(small_loads_are_proportional, 0, way_count) {
    const Way& way = ways[loop];
    constexpr double unit = 1e-9;
    const Scene reference = flexure(way, unit, false);
    Solver exact(reference, 0.0);
    exact.step(1.0);
    const std::vector<double> force = exact.field("reaction");
    const double largest = std::abs(
        *std::max_element(force.begin(), force.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
    bool in_pattern = loop % 2 == 0;  // the load is small, or its factor
    for (const double size : {1e-20, 1e-160, 1e-200, 1e-300}) {
        in_pattern = !in_pattern;
        const Scene scene = flexure(way, size, in_pattern);
        Solver solver(scene, 0.0);
        solver.step(1.0);
        expect_finite(solver, where(way, size));
        expect_held(scene, solver, size, where(way, size));
        const std::vector<double> found = solver.field("reaction");
        for (std::size_t i = 0; i < force.size(); ++i)
            cases::expect_near(found[i] / size, force[i] / unit, 1e-6, largest / unit, where(way, size) + ": reaction");
    }
}

// Energies, about 1e6 J/m2 times the square of the load, overflow at some 1e151 m; that of a pair on the way to its
// debonding, which has softened and opened but holds, at some 1e150 m.
LOOP_TEST(large_loads_are_finite_or_refused, 0, way_count) {
    const Way& way = ways[loop];
    const double largest = std::string(way.rule) == "converged" ? 1e149 : 1e150;
    bool in_pattern = loop % 2 == 0;
    for (const double size : {1e100, largest, 1e200, 1e300}) {
        in_pattern = !in_pattern;
        const Scene scene = flexure(way, size, in_pattern);
        delam_solver* handle = nullptr;
        std::int32_t status = delam_solver_create(scene.problem(), 0.0, &handle);
        const reference::SolverHandle owner(handle);
        if (status == DELAM_OK) {
            Solver solver(scene, 0.0);
            status = solver.advance(1.0);
            std::int32_t pending = 1;
            delam_solver_pending(solver.get(), &pending);
            expect_finite(solver, where(way, size), true);
            if (status == DELAM_OK) expect_held(scene, solver, size, where(way, size));
            cases::expect(pending == (status >= 0 ? 1 : 0), where(way, size) + ": a failed step is pending");
        }
        const std::string message = delam_context_message(scene.context());
        if (size <= largest)
            cases::expect(status == DELAM_OK, where(way, size) + ": " + message);
        else
            cases::expect(status == DELAM_ERROR_NUMERICAL && (message.find("not finite") != std::string::npos ||
                                                              message.find("largest number") != std::string::npos),
                          where(way, size) + ": " + delam_status_name(status) + ": " + message);
    }
}

// A load that ends in rounding (a sine at pi) after a large one.
LOOP_TEST(supports_hold_after_unloading, 0, way_count) {
    const Way& way = ways[loop];
    for (const double fraction : {1e-16, 1e-30, 1e-200}) {
        const double size = 1e-6;
        const Scene scene = flexure(way, size, false, fraction);
        Solver solver(scene, 0.0);
        solver.step(1.0);
        solver.commit();
        solver.step(2.0);
        expect_finite(solver, where(way, size * fraction));
        expect_held(scene, solver, size * fraction, where(way, size * fraction));
    }
}

}  // namespace
