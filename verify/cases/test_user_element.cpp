// SPDX-License-Identifier: BSD-3-Clause
// A sub-laminate as one element of a host: the host knows the displacements of its boundary, requests forces and the
// consistent tangent, and iterates with Newton's method on its own unknowns. The test checks that it converges
// quadratically, and to the library's result when the rest of the structure is part of the library's own scene. Options
// at their defaults do for a host that converges its forces to 1e-5 or less exactly; for more digits it sets
// damage_tolerance.
#include <array>
#include <cmath>

#include "api.hpp"
#include "support.hpp"

namespace {

using reference::Scene;
using reference::Solver;

// Two arms, bonded behind a notch; the boundary: up and sideways at the tip of the upper arm, up at that of the lower
// one.
constexpr std::size_t unknowns = 3;
constexpr const char* names[unknowns] = {"up", "side", "low"};

struct Arms {
    Scene scene;
    std::vector<std::int64_t> upper, lower;  // nodes at the tips
    double share;                            // fraction of the machine that acts on the specimen's width
};

// The machine that drives the element: a spring for each displacement, and its travel at time 1.
constexpr double machine[unknowns] = {3e7, 5e8, 2e7};
constexpr double travel[unknowns] = {1.5e-3, -4e-5, -1.2e-3};
constexpr int steps = 40;

struct Setting {
    int dimension;
    const char* rule;
    double damage_tolerance;  // 0: the default
    double force_tolerance;   // of the host, relative
    bool compared() const { return damage_tolerance > 0.0 && std::string(rule) == "frozen"; }
};
constexpr Setting settings[] = {{2, "frozen", 1e-12, 1e-10},
                                {3, "frozen", 1e-12, 1e-10},
                                {2, "frozen", 0.0, 1e-5},
                                {2, "converged", 0.0, 1e-5},
                                {2, "converged", 1e-11, 1e-10}};  // 1e-12 is rounding
constexpr int setting_count = sizeof settings / sizeof settings[0];

// with_machine: its springs as pairs of the tips with two control nodes that travel; they only pull, as contact
// requires. In space the tips are the middle nodes of the ends, which stay in the plane of symmetry.
Arms arms(const Setting& setting, bool with_machine) {
    const int d = setting.dimension;
    const bool space = d == 3;
    const Scene layers = space ? Scene(3, {0.04, 0.004}, {20, 2}, {1e-3, 1e-3}, {1, 1}, DELAM_HEX8)
                               : Scene(2, {0.04}, {40}, {1e-3, 1e-3}, {1, 1}, DELAM_QUAD4);
    const std::int32_t cell = space ? DELAM_HEX8 : DELAM_QUAD4;
    const double width = space ? 0.004 : 1.0, middle = space ? 0.002 : 0.0;
    std::vector<double> nodes = layers.nodes();
    std::vector<std::int32_t> types(80), bodies(80);
    std::vector<std::int64_t> offsets(81), cells(space ? 640 : 320);
    std::int64_t needed = 0;
    REQUIRE(layers, delam_mesh_cells, layers.mesh(), types.data(), bodies.data(), offsets.data(),
            static_cast<std::int64_t>(cells.size()), cells.data(), &needed);
    const auto at = [&](double x, double y, double z) {
        return space ? std::vector<double>{x, y, z} : std::vector<double>{x, z};
    };
    const auto control = static_cast<std::int64_t>(layers.node_count());
    for (const double z : {4e-3, -2e-3})
        for (const double x : at(0.0, middle, z)) nodes.push_back(x);
    Scene scene(d, nodes, cell, cells, bodies);
    scene.interface(0, 1);
    const auto upper = scene.find(1, at(0.0, middle, 2e-3), at(0.0, middle, 2e-3)),
               lower = scene.find(0, at(0.0, middle, 0.0), at(0.0, middle, 0.0));
    if (with_machine) {
        const double one = 1.0;
        const std::vector<double> down = at(0.0, 0.0, -1.0), up = at(0.0, 0.0, 1.0);
        std::int64_t index = -1;
        scene.require(delam_mesh_add_obstacle(scene.mesh(), 1, upper.data(), down.data(), &one, control, 0, &index),
                      "machine above");
        scene.require(delam_mesh_add_obstacle(scene.mesh(), 1, lower.data(), up.data(), &one, control + 1, 0, &index),
                      "machine below");
    }
    scene.begin();
    scene.elastic(-1, 70e9, 0.3);
    // The steps are chosen so that Newton's method of the host converges with standard cells.
    REQUIRE(scene, delam_problem_set_formulation, scene.problem(), -1, "standard");
    scene.law(0, {1e12, 1e12, 20.0, 40.0, 600.0, 1500.0});
    const auto pairs = scene.pairs(0);
    std::vector<std::int64_t> notch;
    for (std::size_t p = 0; p < pairs.count(); ++p)
        if (scene.coordinate(pairs.node_a[p], 0) < 0.0075) notch.push_back(static_cast<std::int64_t>(p));
    scene.adhesion(0, notch, std::vector<double>(notch.size(), 0.0));
    if (setting.damage_tolerance > 0.0) scene.number("damage_tolerance", setting.damage_tolerance);
    scene.text("mixity_rule", setting.rule);
    const auto root = scene.find(-1, at(0.04, 0.0, 0.0), at(0.04, width, 2e-3));
    const std::vector<double> across = at(0.0, 0.0, 1.0), along = at(1.0, 0.0, 0.0);
    scene.hold(root, along);
    scene.hold(root, across);
    if (space) scene.hold(root, {0.0, 1.0, 0.0});
    const double share = width;  // of forces per metre
    const auto history = [&](std::size_t p) {
        return scene.pattern(names[p], {0.0, 1.0}, {0.0, with_machine ? travel[p] : 0.0});
    };
    scene.drive(with_machine ? std::vector{control} : upper, across, history(0), {1.0});
    scene.drive(with_machine ? std::vector{control} : upper, along, history(1), {1.0});
    scene.drive(with_machine ? std::vector{control + 1} : lower, across, history(2), {1.0});
    if (with_machine) {
        scene.law(1, {share * machine[0], share * machine[1], 1e30, 1e30, 2e30, 2e30});
        scene.law(2, {share * machine[2], 1e-4, 1e30, 1e30, 2e30, 2e30});  // practically free sideways
        scene.hold({control + 1}, along);
        if (space) {
            scene.hold({control}, {0.0, 1.0, 0.0});
            scene.hold({control + 1}, {0.0, 1.0, 0.0});
        }
    }
    return {std::move(scene), upper, lower, share};
}

// Gauss elimination in place; small and simple, as in a host.
std::array<double, unknowns> solved(std::array<std::array<double, unknowns>, unknowns> a,
                                    std::array<double, unknowns> b) {
    for (std::size_t p = 0; p < unknowns; ++p) {
        std::size_t best = p;
        for (std::size_t r = p; r < unknowns; ++r)
            if (std::abs(a[r][p]) > std::abs(a[best][p])) best = r;
        std::swap(a[p], a[best]);
        std::swap(b[p], b[best]);
        for (std::size_t r = p + 1; r < unknowns; ++r) {
            const double f = a[r][p] / a[p][p];
            for (std::size_t c = p; c < unknowns; ++c) a[r][c] -= f * a[p][c];
            b[r] -= f * b[p];
        }
    }
    for (std::size_t p = unknowns; p-- > 0;) {
        for (std::size_t c = p + 1; c < unknowns; ++c) b[p] -= a[p][c] * b[c];
        b[p] /= a[p][p];
    }
    return b;
}

LOOP_TEST(newton_of_a_host, 0, setting_count) {
    const Setting& setting = settings[loop];
    const Arms element = arms(setting, false), structure = arms(setting, true);
    std::array<double, unknowns> spring{};
    for (std::size_t p = 0; p < unknowns; ++p) spring[p] = element.share * machine[p];
    Solver solver(element.scene, 0.0), whole(structure.scene, 0.0);
    std::array<double, unknowns> u{};
    int quadratic = 0;
    for (int k = 1; k <= steps; ++k) {
        const double time = static_cast<double>(k) / steps;
        const std::string where = "step " + std::to_string(k);
        std::vector<double> history;  // residuals, relative
        for (;;) {
            cases::expect(history.size() < 8, where + ": Newton's method of the host does not converge");
            for (std::size_t p = 0; p < unknowns; ++p)
                REQUIRE(element.scene, delam_solver_set_history, solver.get(), static_cast<std::int64_t>(p), 1, &time,
                        &u[p]);
            solver.step(time);
            std::array<double, unknowns> residual{};
            double norm = 0.0, scale = 0.0;
            for (std::size_t p = 0; p < unknowns; ++p) {
                residual[p] = solver.value(std::string("reaction:") + names[p]) + spring[p] * (u[p] - travel[p] * time);
                scale = std::max(scale, std::abs(spring[p] * travel[p] * time));
                norm = std::max(norm, std::abs(residual[p]));
            }
            history.push_back(norm / scale);
            if (history.back() <= setting.force_tolerance) break;
            std::vector<double> tangent(unknowns * unknowns);
            REQUIRE(element.scene, delam_solver_step_tangent, solver.get(), 9, tangent.data());
            solver.rollback();
            std::array<std::array<double, unknowns>, unknowns> matrix{};
            for (std::size_t p = 0; p < unknowns; ++p)
                for (std::size_t q = 0; q < unknowns; ++q)
                    matrix[p][q] = tangent[p * unknowns + q] + (p == q ? spring[p] : 0.0);
            const auto change = solved(matrix, residual);
            for (std::size_t p = 0; p < unknowns; ++p) u[p] -= change[p];
        }
        solver.commit();
        // The last error is the square of the one before, times a constant of moderate size.
        const std::size_t n = history.size();
        const double rest = 0.1 * setting.force_tolerance;
        if (n >= 3 && history[n - 2] < 1e-3 && history[n - 1] <= 100.0 * history[n - 2] * history[n - 2] + rest)
            ++quadratic;

        if (!setting.compared()) continue;
        // The same structure in one scene of the library.
        whole.step(time);
        whole.commit();
        for (std::size_t p = 0; p < unknowns; ++p) {
            const double force = whole.value(std::string("reaction:") + names[p]);
            cases::expect_near(-solver.value(std::string("reaction:") + names[p]), -force, 1e-6,
                               std::abs(spring[p] * travel[p]) * 0.05 + std::abs(force), where + ": force " + names[p]);
        }
        cases::expect_near(solver.value("dissipated"), whole.value("dissipated"), 1e-6,
                           0.1 * element.share + whole.value("dissipated"), where + ": dissipated");
        cases::expect_near(solver.value("debonded_length"), whole.value("debonded_length"), 1e-9, 1.0,
                           where + ": debonded length");
    }
    cases::expect(solver.value("dissipated") > 0.1 * element.share, "nothing was damaged");
    cases::expect(quadratic >= 15, "quadratic in " + std::to_string(quadratic) + " steps only");
}

// A host that tries a step many times is not warned as often.
TEST(warned_once) {
    static int warnings;
    warnings = 0;
    const Arms element = arms(settings[2], false);
    element.scene.require(delam_context_set_log(
                              element.scene.context(),
                              [](std::int32_t, const char* line, void*) {
                                  if (std::string(line).find("the mode mixity changes on the way") != std::string::npos)
                                      ++warnings;
                              },
                              nullptr),
                          "delam_context_set_log");
    Solver solver(element.scene, 0.0);
    const double time = 1.0;
    const auto trial = [&](double turned) {
        const double u[unknowns] = {4e-4 * (1.0 - turned), -2e-4 * turned, 0.0};
        for (std::size_t p = 0; p < unknowns; ++p)
            REQUIRE(element.scene, delam_solver_set_history, solver.get(), static_cast<std::int64_t>(p), 1, &time,
                    &u[p]);
        solver.advance(time);
        const double error = solver.value("mixity_error");
        solver.rollback();
        return error;
    };
    double worst = 0.0;
    int above = 0;
    for (int i = 0; i < 6; ++i) {
        const double error = trial(0.15 * i);
        above += error > 0.1 ? 1 : 0;
        worst = std::max(worst, error);
    }
    cases::expect(above >= 2, "mixity_error up to " + std::to_string(worst) + ": nothing to warn of twice");
    cases::expect(warnings == 1, std::to_string(warnings) + " warnings");
}

}  // namespace
