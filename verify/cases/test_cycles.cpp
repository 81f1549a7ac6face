// SPDX-License-Identifier: BSD-3-Clause
// Unloading: unloading to exactly zero keeps damage and mixity, with every preconditioner; a body with exactly as many
// supports as it has rigid motions is held on every mesh.
#include "api.hpp"
#include "enf.hpp"
#include "support.hpp"

namespace {

using reference::Scene;
using reference::Solver;

constexpr reference::LawData law{125e9, 80e9, 100.0, 160.0, 250.0, 480.0};
constexpr const char* preconditioners[] = {"none", "lumped", "dirichlet", "series"};

// The lower block is fixed, and the pattern slides the upper one.
Scene slide(double amount, const char* preconditioner) {
    Scene scene(2, {1.0}, {1}, {1.0, 1.0}, {1, 1}, DELAM_QUAD4);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, 1e9, 0.2);
    scene.law(0, law);
    const auto load = scene.pattern("slide", {0.0, 1.0, 2.0, 3.0}, {0.0, amount, 0.0, amount});
    const auto below = scene.find(0, {0.0, 0.0}, {1.0, 2.0});
    const auto above = scene.find(1, {0.0, 0.0}, {1.0, 2.0});
    scene.hold(below, {0.0, 1.0});
    scene.hold(above, {0.0, 1.0});
    scene.hold(below, {1.0, 0.0});
    scene.drive(above, {1.0, 0.0}, load, std::vector<double>(above.size(), 1.0));
    scene.text("preconditioner", preconditioner);
    return scene;
}

LOOP_TEST(a_cycle_through_zero_keeps_damage_and_mode, 0, 4) {
    const double amount = 1e-4;  // onset at 6.3e-5, debonded at 1.9e-4
    const Scene scene = slide(amount, preconditioners[loop]);
    Solver solver(scene, 0.0);
    for (int k = 1; k <= 10; ++k, solver.commit()) solver.step(0.1 * k);
    const double adhesion = solver.field("adhesion")[0];
    const double dissipated = solver.value("dissipated");
    cases::expect(adhesion > 0.0 && adhesion < 1.0, "the interface is damaged, or nothing was tested");
    for (int k = 11; k <= 20; ++k, solver.commit()) solver.step(0.1 * k);
    for (const double t : solver.field("traction")) cases::expect(t == 0.0, "no load, no traction");
    cases::expect(solver.value("stored_bulk") == 0.0, "no load, no energy");
    for (int k = 21; k <= 30; ++k, solver.commit()) solver.step(0.1 * k);
    cases::expect_near(solver.field("adhesion")[0], adhesion, 1e-12, 1.0, "adhesion after the cycle");
    cases::expect_near(solver.value("dissipated"), dissipated, 1e-12, dissipated, "dissipated after the cycle");
    for (const double b : solver.field("mixity")) cases::expect_near(b, 1.0, 1e-12, 1.0, "mode II is remembered");
}

// The whole ENF: bent, released, bent again. The second bending is elastic, along the secant.
TEST(enf_released_and_bent_again) {
    cases::Enf e;
    e.h = 1.5e-3;
    const Scene scene = cases::make_enf(e);
    Solver solver(scene, 0.0);
    for (int k = 1; k <= 20; ++k, solver.commit()) solver.step(0.1 * k);
    const double dissipated = solver.value("dissipated");
    const auto adhesion = solver.field("adhesion");
    solver.equilibrate(0.0, adhesion);
    for (const double j : solver.field("jump")) cases::expect(j == 0.0, "released");
    solver.commit();
    cases::expect(solver.value("dissipated") == dissipated, "release dissipates nothing");
}

// A simply supported layer: three supports, three rigid motions, a dead force on top.
LOOP_TEST(statically_determinate_layer, 0, 4) {
    const int cells = 8 << loop;
    Scene scene(2, {0.08}, {cells}, {0.01}, {cells / 8}, DELAM_QUAD4);
    scene.begin();
    scene.elastic(-1, 70e9, 0.3);
    scene.hold(scene.find(0, {0.0, 0.0}, {0.0, 0.0}), {0.0, 1.0});
    scene.hold(scene.find(0, {0.08, 0.0}, {0.08, 0.0}), {0.0, 1.0});
    scene.hold(scene.find(0, {0.08, 0.0}, {0.08, 0.0}), {1.0, 0.0});
    const auto load = scene.pattern("load", {0.0, 1.0}, {0.0, 1.0});
    const auto top = scene.find(0, {0.04, 0.01}, {0.04, 0.01});
    const double force[2] = {0.0, -1000.0};
    REQUIRE(scene, delam_problem_add_forces, scene.problem(), load, 1, top.data(), force, 0);
    Solver solver(scene, 0.0);
    solver.step(1.0);
    const auto reaction = solver.field("reaction");
    cases::expect_near(reaction[0], 500.0, 1e-9, 500.0, "left reaction");
    cases::expect_near(reaction[1], 500.0, 1e-9, 500.0, "right reaction");
    cases::expect_near(reaction[2], 0.0, 1e-9, 500.0, "no thrust");
    // Clapeyron, with the displacements themselves.
    const auto u = solver.field("displacement");
    const double work = -1000.0 * u[static_cast<std::size_t>(2 * top[0] + 1)];
    cases::expect_near(solver.value("stored_bulk"), 0.5 * work, 1e-9, work, "stored");
    cases::expect_near(solver.value("load_potential"), -work, 1e-9, work, "potential");
    cases::expect_below(solver.value("kkt_equilibrium"), 1e-9, "equilibrium");
}

}  // namespace
