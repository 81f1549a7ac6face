// SPDX-License-Identifier: BSD-3-Clause
// The exhaustive scan of fronts itself: energies are quadratic in the load and mixities do not depend on it, fronts
// agree with the direct solver, and a scan that solves for every front at every load step finds the same states.
#include <algorithm>
#include <limits>

#include "direct.hpp"
#include "fronts.hpp"
#include "support.hpp"

namespace {

using reference::Fronts;
using reference::MixityRule;

// ENF and MMF, at points and on patches: loop 0 .. 3.
reference::Flexure specimen(int loop, double h = 1.5e-3) {
    reference::Flexure data = reference::find_flexure(loop % 2 == 0 ? "enf-brittle" : "mmf-brittle");
    data.h = h;
    data.patch = loop < 2 ? 0.0 : 2e-3;
    return data;
}

std::vector<double> broken_up_to(const reference::FlexureScene& s, std::size_t first_intact) {
    std::vector<double> adhesion = s.adhesion;
    std::fill(adhesion.begin(), adhesion.begin() + static_cast<std::ptrdiff_t>(first_intact), 0.0);
    return adhesion;
}

double stored(const reference::Solver& solver) {
    return solver.value("stored_bulk") + solver.value("stored_interface");
}

LOOP_TEST(energy_is_quadratic_in_the_load, 0, 4) {
    const Fronts fronts(specimen(loop));
    const reference::FlexureScene& s = fronts.flexure();
    std::size_t first = 0;
    for (const double load : {0.03e-3, 0.5e-3, 2.7e-3, 6e-3}) {
        for (std::size_t f = first; f < fronts.list().size(); f += 20) {
            // Contact sets are not passed from front to front here.
            reference::Solver solver(s.scene, 0.0);
            const reference::Front& front = fronts.list()[f];
            solver.equilibrate(s.data.time(load), broken_up_to(s, front.first_intact));
            const std::string where = "load " + std::to_string(load) + ", front " + std::to_string(f) + ": ";
            const double energy = fronts.stored(f, load);
            cases::expect_near(stored(solver), energy, 2e-9, energy, where + "stored energy");
            const auto jump = solver.field("jump");
            const std::size_t p = front.first_intact;
            const double normal = s.data.law.normal_stiffness * jump[2 * p] * jump[2 * p];
            const double tangential = s.data.law.tangential_stiffness * jump[2 * p + 1] * jump[2 * p + 1];
            cases::expect_near(tangential / (normal + tangential), front.mixity[p], 1e-7, 1.0,
                               where + "mixity at the front");
        }
        first += 5;  // every load has fronts of its own
    }
}

LOOP_TEST(fronts_agree_with_the_direct_solver, 0, 4) {
    const Fronts fronts(specimen(loop));
    const reference::FlexureScene& s = fronts.flexure();
    reference::DirectReference direct(s.scene);
    for (std::size_t f = 0; f < fronts.list().size(); f += 9) {
        const auto state = direct.solve(s.data.time(1e-3), broken_up_to(s, fronts.list()[f].first_intact));
        const double energy = state.stored_bulk + state.stored_interface;
        cases::expect_near(fronts.stored(f, 1e-3), energy, 1e-9, energy, "front " + std::to_string(f));
    }
}

// Breaking more pairs never stores more energy.
LOOP_TEST(energy_falls_with_the_front, 0, 4) {
    const Fronts fronts(specimen(loop));
    for (std::size_t f = 1; f < fronts.list().size(); ++f)
        cases::expect_below(fronts.stored(f, 1e-3), fronts.stored(f - 1, 1e-3) * (1.0 + 1e-9),
                            "front " + std::to_string(f));
}

// Nothing is reused: every front at every load, each by a separate displacement step.
LOOP_TEST(scan_is_exhaustive, 0, 4) {
    if (loop % 2 == 1 && !cases::whole()) return;
    const reference::Flexure data = specimen(loop);
    const Fronts fronts(data);
    const reference::FlexureScene& s = fronts.flexure();
    std::vector<double> loads{0.15e-3, 0.45e-3, 6e-3};
    if (loop < 2) loads = {0.15e-3, 0.30e-3, 0.45e-3, 1.2e-3, 6e-3};
    const auto steps = fronts.scan(loads, MixityRule::pure);
    reference::Solver solver(s.scene, 0.0);
    const std::size_t tip = fronts.list()[0].first_intact;
    std::size_t at = tip;
    for (std::size_t k = 0; k < loads.size(); ++k) {
        double best = std::numeric_limits<double>::infinity();
        std::size_t best_at = at;
        for (std::size_t front = at; front < s.weight.size(); ++front) {
            solver.equilibrate(data.time(loads[k]), broken_up_to(s, front));
            double total = stored(solver);
            solver.rollback();
            for (std::size_t p = tip; p < front; ++p) total += s.weight[p] * data.law.tangential_toughness;
            if (total >= best) continue;
            best = total;
            best_at = front;
        }
        at = best_at;
        const std::string where = "step " + std::to_string(k + 1) + ": ";
        cases::expect(fronts.list()[steps[k].front].first_intact == at, where + "another front");
        cases::expect_near(steps[k].total(), best, 2e-9, best, where + "energy");
    }
}

// The load of the jump is where the energies cross: just below it the scan stays, just above it has jumped.
LOOP_TEST(crossing_of_the_energies, 0, 4) {
    const Fronts fronts(specimen(loop));
    for (const MixityRule rule : {MixityRule::pure, MixityRule::frozen, MixityRule::converged}) {
        const auto crossing = fronts.crossing(rule);
        const std::string name = reference::rule_name(rule);
        cases::expect(crossing.front > 0, name + ": no crossing");
        cases::expect(fronts.scan({crossing.load * (1.0 - 1e-9)}, rule)[0].front == 0,
                      name + ": a jump below its load");
        cases::expect(fronts.scan({crossing.load * (1.0 + 1e-9)}, rule)[0].front == crossing.front,
                      name + ": no jump above its load");
        cases::expect(fronts.crossing(rule, true).load >= crossing.load,
                      name + ": Griffith's local load is below the energetic one");
    }
}

// The ENF is pure mode II: the criterion's exponents change the toughness by less than 0.1 %. The MMF has beam theory's
// psi^2 = 3/4 at the front, 35 J/m2, while pairs far ahead keep the mixity that they had before the front came.
TEST(mixity_rules_differ_in_the_mixed_mode_only) {
    const Fronts enf(specimen(0, 1e-3));
    const auto middle = enf.list().size() / 2;
    const double pure = enf.dissipated(0, middle, MixityRule::pure);
    for (const MixityRule rule : {MixityRule::frozen, MixityRule::converged})
        cases::expect_near(enf.dissipated(0, middle, rule), pure, 1e-3, pure,
                           std::string("ENF, ") + reference::rule_name(rule));
    const Fronts mmf(specimen(1, 1e-3));
    const auto crossing = mmf.crossing(MixityRule::converged);
    const double advance = mmf.list()[crossing.front].advance;
    cases::expect_near(crossing.dissipated / advance, 35.0, 0.01, 35.0,
                       "MMF, mean toughness along the way of the front");
    const auto frozen = mmf.crossing(MixityRule::frozen);
    cases::expect_below(frozen.dissipated / mmf.list()[frozen.front].advance, 28.0,
                        "MMF, frozen mixity of pairs far ahead");
}

}  // namespace
