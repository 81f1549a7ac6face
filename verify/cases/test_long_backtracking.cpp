// SPDX-License-Identifier: BSD-3-Clause
// Fine analyses of the mixed-mode flexure test with returns: the loops terminate, and the results satisfy the same
// checks as without returns.
#include "mmf.hpp"
#include "support.hpp"

namespace {

using reference::Solver;

LOOP_TEST(returns_end, 0, 6) {
    const char* rules[] = {"frozen", "converged", "variational"};
    const bool brittle = loop >= 3;
    const int steps = 320;
    reference::LawData law = brittle ? cases::mmf_brittle : cases::mmf_ductile;
    if (loop == 5) {  // the variational rule allows the toughness to vary by twice the onset
        law.tangential_toughness += 2.0 * law.normal_onset;
        law.exponent = 1.0;
    }
    reference::Scene scene = cases::make_mmf(1e-3, law, rules[loop % 3]);
    scene.text("backtracking", "on");
    scene.number("backtracking_tolerance", loop == 0 ? 1e-6 : 1e-3);
    // A brittle front that jumps late returns to where the bound is first missed, over a hundred steps.
    const double limit = 300.0;
    scene.number("backtracking_limit", limit);
    Solver solver(scene, 0.0);
    double returns = 0.0, most = 0.0;
    for (int k = 1; k <= steps; ++k) {
        const std::int32_t status = solver.advance(cases::enf_time(k, steps));
        scene.require(status < 0 ? status : 0, "delam_solver_advance");
        returns += solver.value("backtracks");
        most = std::max(most, solver.value("backtracks"));
        solver.commit();
    }
    int violated = 0;
    for (int k = 1; k <= steps; ++k) {
        scene.require(delam_solver_look(solver.get(), k), "delam_solver_look");
        const double size = std::max(std::abs(solver.value("stored_bulk")), solver.value("work"));
        violated += solver.value("lower") - solver.value("increment") > 1e-3 * size ? 1 : 0;
    }
    std::printf("MMF, %s, %s: %g returns, at most %g in a step, %d bounds missed, %.5g J/m\n",
                brittle ? "brittle" : "ductile", rules[loop % 3], returns, most, violated, solver.value("dissipated"));
    cases::expect_below(most, limit - 1.0, "returns in a step: the limit ended them");
    if (!brittle) cases::expect(violated == 0, "bounds missed: " + std::to_string(violated));
    cases::expect(solver.value("dissipated") > 0.0, "something breaks");
}

}  // namespace
