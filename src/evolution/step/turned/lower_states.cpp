// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/step/turned/lower_states.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

namespace delam {

namespace {

// A step finds at most so many lower states one after another: it has two or three, each of which has a front farther
// on. (`delam run examples/enf-brittle-energetic/enf-brittle-energetic.toml --set solver.kinematics=corotational`: half
// and twice leave every digit of history.csv.)
constexpr std::int64_t most_rounds = 8;

double height_of(const State& state) { return state.ledger.energy() + state.ledger.dissipated; }

double change(const State& a, const State& b) {
    double most = 0.0;
    for (std::size_t p = 0; p < a.adhesion.size(); ++p) most = std::max(most, std::abs(a.adhesion[p] - b.adhesion[p]));
    return most;
}

}  // namespace

Stepper::Result LowerStates::lowest(Stepper::Result best, double least, double damage_tolerance) const {
    for (std::int64_t round = 0; best.converged && round < most_rounds; ++round) {
        const Stepper::Result found = search(best.state);
        best.state.effort.add(found.state.effort);
        best.searched += found.searched;
        // States that are left out were compared in a linearised scene, whose energies bound no true ones.
        best.state.outcome.search_gap = std::numeric_limits<double>::infinity();
        if (!(change(found.state, best.state) > damage_tolerance)) break;
        Stepper::Result lower = settle(best.state, Stepper::Start(found.state, false));
        const double noise = least * std::abs(height_of(best.state));
        lower.state.effort.add(best.state.effort);
        if (!lower.converged || !(height_of(lower.state) < height_of(best.state) - noise)) {
            best.state.effort = lower.state.effort;
            break;
        }
        lower.searched = best.searched;
        lower.state.outcome.search_gap = best.state.outcome.search_gap;
        best = std::move(lower);
    }
    return best;
}

JumpWithin jump_to_lower(const PairLaws& pairs, const State& local, const State& lower) {
    JumpWithin jump;
    jump.known = JumpWithin::told_by_search;
    jump.load = 1.0;
    for (std::size_t p = 0; p < lower.adhesion.size(); ++p)
        jump.debonded += pairs.weight[p] * (local.adhesion[p] - lower.adhesion[p]);
    jump.conjugate_before = local.response.conjugate;
    jump.conjugate_after = lower.response.conjugate;
    return jump;
}

}  // namespace delam
