// SPDX-License-Identifier: BSD-3-Clause
// Mixed-mode bending with a toughness that depends strongly on the mode, default options: the crack jumps by a third of
// its length, and load and ledger must not depend on the number of steps.
#include <algorithm>
#include <cmath>
#include <vector>

#include "enf.hpp"
#include "support.hpp"

namespace {

using reference::Scene;
using reference::Solver;

// Criterion 8 times as tough in shear as in opening; strengths in the ratio of the roots of the toughnesses (Turon et
// al., Eng. Fract. Mech. 77, 2010), so that the mixity of a front is that of its whole softening zone.
constexpr double opening = 200.0, shear = 1600.0, stiffness = 1e14, strength = 20e6, exponent = 2.0;
constexpr double onset = 0.5 * strength * strength / stiffness;
constexpr reference::LawData law{stiffness, stiffness, onset, onset* shear / opening, opening, shear, exponent};
constexpr double half_span = 0.058, young = 75e9, end_load = 5e-3;

// By beam theory four fifths of the energy are in mode II: G_I/G_II = 4/3 ((3c - L)/(c + L))^2 = 1/4.
double lever() {
    const double root = std::sqrt(3.0) / 4.0;
    return half_span * (1.0 + root) / (3.0 - root);
}

Scene bending(double h) {
    const auto along = static_cast<std::int64_t>(std::lround(cases::enf_length / h));
    Scene scene(2, {cases::enf_length}, {along}, {cases::enf_arm, cases::enf_arm}, {2, 2}, DELAM_QUAD4);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, young, 0.3);
    scene.law(0, law);
    const auto x = cases::enf_positions(scene);
    std::vector<std::int64_t> notch;
    for (std::size_t i = 0; i < x.size(); ++i)
        if (x[i] < cases::enf_notch - 0.25 * h) notch.push_back(static_cast<std::int64_t>(i));
    scene.adhesion(0, notch, std::vector<double>(notch.size(), 0.0));
    const double top = 2.0 * cases::enf_arm;
    const auto hinge = scene.find(0, {0.0, 0.0}, {0.0, 0.0});
    scene.hold(hinge, {1.0, 0.0});
    scene.hold(hinge, {0.0, 1.0});
    scene.hold(scene.find(0, {2.0 * half_span, 0.0}, {2.0 * half_span, 0.0}), {0.0, 1.0});
    const auto middle = scene.find(1, {half_span, top}, {half_span, top});
    const auto end = scene.find(1, {0.0, top}, {0.0, top});
    const auto press = scene.pattern("press", {0.0, 1.0}, {0.0, end_load});
    const double share = lever() / half_span;
    scene.equation({middle.at(0), end.at(0)}, {0.0, 1.0 + share, 0.0, -share}, press, -1.0);
    return scene;
}

struct Analysis {
    std::vector<double> load, crack, dissipated;
    double defect = 0.0, work = 0.0;  // largest |stored + dissipated + released - work|; work at the end
    double worst_fall = 1.0;          // least ratio of the loads after and before a step
    bool named = false;               // that step has a recorded jump
};

std::vector<std::int64_t> steps_of_jumps(const Scene& scene, const Solver& solver) {
    std::int64_t count = 0;
    REQUIRE(scene, delam_solver_jump_count, solver.get(), &count);
    std::vector<std::int64_t> steps;
    for (std::int64_t i = 0; i < count; ++i) {
        std::int64_t step = 0;
        REQUIRE(scene, delam_solver_jump, solver.get(), i, &step, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr,
                nullptr, nullptr, nullptr);
        steps.push_back(step);
    }
    return steps;
}

Analysis analyse(const Scene& scene, int steps) {
    Solver solver(scene, 0.0);
    Analysis m;
    double released = 0.0;
    for (int k = 1; k <= steps; ++k) {
        solver.step(static_cast<double>(k) / steps);
        solver.commit();
        released += solver.value("released");
        const double recorded = solver.value("stored_bulk") + solver.value("stored_interface") +
                                solver.value("dissipated") + released - solver.value("work");
        m.defect = std::max(m.defect, std::abs(recorded));
        m.load.push_back(solver.value("reaction:press"));
        m.crack.push_back(solver.value("crack_length"));
        m.dissipated.push_back(solver.value("dissipated"));
    }
    m.work = solver.value("work");
    const std::vector<std::int64_t> jumps = steps_of_jumps(scene, solver);
    std::int64_t fall = 0;
    for (std::size_t k = 1; k < m.load.size(); ++k) {
        const double ratio = m.load[k] / m.load[k - 1];
        if (ratio >= m.worst_fall) continue;
        m.worst_fall = ratio;
        fall = static_cast<std::int64_t>(k) + 1;
    }
    m.named = std::find(jumps.begin(), jumps.end(), fall) != jumps.end();
    return m;
}

TEST(steps_do_not_matter) {
    const Scene scene = bending(1e-3);
    const Analysis coarse = analyse(scene, 20), fine = analyse(scene, 80);
    for (std::size_t k = 0; k < coarse.load.size(); ++k)
        cases::expect_near(coarse.load[k], fine.load[4 * k + 3], 0.02, fine.load[4 * k + 3],
                           "load in step " + std::to_string(k + 1) + " of 20");
    // A long step begins its jump at a higher load. The softening zone on the way is then another one, and the
    // dissipation of a pair depends on the way.
    const double spent = fine.dissipated.back();
    cases::expect_near(coarse.dissipated.back(), spent, 0.05, spent, "dissipated energy of 20 steps");
    cases::expect_below(20.0, spent, "dissipated energy, J/m: the crack runs");
    for (const Analysis* m : {&coarse, &fine})
        cases::expect_below(m->defect / m->work, 1e-3, "defect of the ledger with its released energy, over the work");
    cases::expect_below(fine.worst_fall, 0.9, "largest fall of the load in a step of 80, ratio");
    for (const Analysis* m : {&coarse, &fine})
        cases::expect(m->named, "no jump is recorded in the step in which the load falls most");
}

}  // namespace
