// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/increment/rule/frozen_increment.hpp"

#include <cmath>

namespace delam {

std::unique_ptr<StepRule> FrozenIncrement::starting_at(const PairMixities& mixity) const {
    return std::make_unique<FrozenIncrement>(pairs_, before_, mixity, limits_, this);
}

double FrozenIncrement::energy(std::span<const double> adhesion, std::span<const double> jump) const {
    return stored_energy(pairs_, adhesion, jump) + dissipation(pairs_, now_.toughness, before_.adhesion, adhesion);
}

std::vector<double> FrozenIncrement::damage_step(std::span<const double> adhesion, std::span<const double> jump) const {
    return delam::damage_step(pairs_, now_.toughness, before_.adhesion, adhesion, jump,
                              [this](std::size_t pair) { return least(pair); });
}

bool FrozenIncrement::displace(const DisplacementSolve& solve, State& state) const {
    return solve(spring_stiffness(pairs_, state.adhesion), {}, state.closed, state.response);
}

double FrozenIncrement::cost(const PairMixities& mixity, std::span<const double> adhesion) const {
    return dissipation(pairs_, mixity, before_.adhesion, adhesion);
}

void FrozenIncrement::record_rule(State& next, double /*energy_change_linear*/) const {
    next.ledger.dissipated_linear =
        before_.ledger.dissipated_linear + dissipation_linear(pairs_, next.mixity, before_.adhesion, next.adhesion);
}

bool FrozenIncrement::damaging(const State& state, std::size_t pair, bool coupled) const {
    const Law* law = pairs_.law[pair];
    const double zeta = state.adhesion[pair], before = before_.adhesion[pair];
    if (law == nullptr || !(zeta > 0.0) || !(zeta < before)) return false;
    const Toughness toughness = pairs_.toughness(pair, state.mixity[pair]);
    if (!std::isfinite(law->driving_slope(toughness, zeta))) return false;
    if (coupled) return true;
    const double y = driving_energy(*law, local(state.response.jump, pair)).total();
    // A pair that was damaged earlier in the step may be at rest at its end.
    return law->slope(toughness, y, before) < 0.0 &&
           change(pair, zeta, law->minimiser(toughness, y, before), y) <= 10.0 * limits_.tolerance;
}

// v = w k j,   omega = k j (less what the mixity adds),   own = -g''.
std::vector<PairDirection> FrozenIncrement::directions(const State& state) const {
    std::vector<std::uint8_t> coupled(state.adhesion.size(), 0);
    for (const auto& term : pairs_.gradient)
        for (std::size_t p = 0; p < term->pairs(); ++p) coupled[term->first() + p] = term->coupled(p) ? 1 : 0;
    std::vector<PairDirection> found;
    for (std::size_t p = 0; p < state.adhesion.size(); ++p) {
        if (!damaging(state, p, coupled[p] != 0)) continue;
        const Law& law = *pairs_.law[p];
        const std::span<const double> jump = local(state.response.jump, p);
        PairDirection direction{p, std::vector<double>(jump.size(), 0.0), std::vector<double>(jump.size(), 0.0),
                                law.driving_slope(pairs_.toughness(p, state.mixity[p]), state.adhesion[p])};
        for (std::size_t c = state.closed[p] != 0 ? 1 : 0; c < jump.size(); ++c) {
            const double pull = law.stiffness(c) * jump[c];
            direction.force[c] = pairs_.weight[p] * pull;
            direction.form[c] = pull;
        }
        add_mixity(direction, state);
        found.push_back(std::move(direction));
    }
    return found;
}

}  // namespace delam
