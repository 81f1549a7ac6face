// SPDX-License-Identifier: BSD-3-Clause
// The two-sided energy estimate where several loads change at rates of their own, against displacement solves at the
// adhesion before and after the step.
#include <algorithm>
#include <string>
#include <vector>

#include "controlled_scenes.hpp"
#include "support.hpp"

namespace {

using cases::Scene;
using reference::Solver;

using Factors = std::vector<double>;

// Shares of the two loads' ends at the ends of the steps: in proportion, turned little by little, exchanged, reversed.
const std::vector<Factors> path = {{0.3, 0.3}, {0.5, 0.5}, {0.7, 0.69999}, {0.8, 0.9},
                                   {1.0, 0.7}, {0.9, 1.4}, {1.5, -0.2}};

// Stored in bodies and interfaces, and the potential of dead loads.
double energy(const Solver& s) {
    return s.value("stored_bulk") + s.value("stored_interface") + s.value("load_potential");
}

struct Loaded {
    Scene scene;
    Factors ends;
    Loaded(int d, bool lever)
        : scene(lever ? cases::make_lever(d)
                      : cases::make_plies(d, 3, d == 2 ? DELAM_QUAD4 : DELAM_HEX8, "incompatible", cases::block_law)),
          ends(lever ? Factors{4e-4, 600.0} : Factors{3e-5, 2e-5}) {
        scene.text("step_control", "fixed");
        scene.text("mixity_rule", "frozen");
    }
    void set(Solver& solver, double time, const Factors& shares) const {
        for (std::size_t p = 0; p < ends.size(); ++p) {
            const double factor = shares[p] * ends[p];
            REQUIRE(scene, delam_solver_set_history, solver.get(), static_cast<std::int64_t>(p), 1, &time, &factor);
        }
    }
    void step(Solver& solver, double time, const Factors& shares) const {
        set(solver, time, shares);
        solver.step(time);
    }
};

// Energies at the loads of one end of a step and the adhesion of the other lie within the estimate: E is least over all
// displacements, so that no bound that holds some of them may pass it.
LOOP_TEST(energies_of_either_end, 0, 4) {
    const Loaded of(loop % 2 == 0 ? 2 : 3, loop / 2 == 1);
    Solver solver(of.scene, 0.0), at_next(of.scene, 0.0), at_before(of.scene, 0.0);
    int damaged = 0;
    Factors shares_before = {0.0, 0.0};
    double before = energy(solver);
    std::vector<double> zeta_before = solver.field("adhesion");
    for (std::size_t k = 0; k < path.size(); ++k) {
        const double time = static_cast<double>(k + 1);
        const std::string where = "step " + std::to_string(k + 1) + ": ";
        of.step(solver, time, path[k]);
        const std::vector<double> zeta = solver.field("adhesion");
        const double now = energy(solver), lower = solver.value("lower"), upper = solver.value("upper");
        // The adhesion before under the loads after, and the other way round.
        of.set(at_next, time, path[k]);
        at_next.equilibrate(time, zeta_before);
        const double over = energy(at_next) - before;
        at_next.commit();
        of.set(at_before, time, shares_before);
        at_before.equilibrate(time, zeta);
        const double under = now - energy(at_before);
        at_before.commit();
        const double size = std::max({std::abs(now), std::abs(over), std::abs(under), 1e-12});
        const double increment = solver.value("increment");
        cases::expect_below(over - upper, 1e-8 * size, where + "upper bound");
        cases::expect_below(lower - under, 1e-8 * size, where + "lower bound");
        cases::expect_below(increment - upper, 1e-8 * size, where + "increment above its bound");
        // The bounds of loads in proportion are those energies, and almost those where they hardly turn.
        if (k > 0 && k < 3) {
            cases::expect_near(upper, over, 1e-6, size, where + "upper");
            cases::expect_near(lower, under, 1e-6, size, where + "lower");
        }
        damaged += zeta != zeta_before ? 1 : 0;
        solver.commit();
        before = now;
        zeta_before = zeta;
        shares_before = path[k];
    }
    cases::expect(damaged >= 3, "steps that damage: " + std::to_string(damaged));
}

// Loads that leave proportion a little change the estimate, and the substeps of adaptive steps, a little.
LOOP_TEST(continuous_in_the_loads, 0, 4) {
    Loaded of(loop % 2 == 0 ? 2 : 3, loop / 2 == 1);
    of.scene.text("step_control", "adaptive");
    std::vector<double> seen[2];
    for (const double turned : {0.0, 1e-8}) {
        Solver solver(of.scene, 0.0);
        for (int k = 1; k <= 3; ++k) {
            of.step(solver, k, {0.3 * k, 0.3 * k * (1.0 + turned)});
            for (const char* key : {"lower", "upper", "increment", "substeps"})
                seen[turned > 0.0].push_back(solver.value(key));
            solver.commit();
        }
    }
    double size = 0.0;
    for (const double v : seen[0]) size = std::max(size, std::abs(v));
    for (std::size_t i = 0; i < seen[0].size(); ++i)
        cases::expect_near(seen[1][i], seen[0][i], 1e-6, i % 4 == 3 ? 1.0 : std::abs(seen[0][i]) + 1e-12,
                           "value " + std::to_string(i % 4) + " of step " + std::to_string(i / 4 + 1));
    cases::expect(size > 0.0, "loaded");
}

}  // namespace
