// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/increment/rule/variational_increment.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/error.hpp"
#include "evolution/increment/rule/curved_displacement.hpp"

namespace delam {

namespace {

// Part of a spring below which the force of a pair differs from that of its spring by rounding.
constexpr double same_as_spring = 1e-12;

}  // namespace

std::unique_ptr<StepRule> VariationalIncrement::starting_at(const PairMixities& mixity) const {
    return std::make_unique<VariationalIncrement>(pairs_, before_, mixity, limits_, this);
}

double VariationalIncrement::energy(std::span<const double> adhesion, std::span<const double> jump) const {
    const PairMixities own = mixities(pairs_, jump, now_.used);
    return stored_energy(pairs_, adhesion, jump) + stored_linear(pairs_, own, adhesion) +
           dissipation_linear(pairs_, now_.used, before_.adhesion, adhesion);
}

std::vector<double> VariationalIncrement::damage_step(std::span<const double> adhesion,
                                                      std::span<const double> jump) const {
    std::vector<Toughness> toughness = now_.toughness;
    std::vector<double> driving(adhesion.size(), 0.0);
    for (std::size_t p = 0; p < driving.size(); ++p) {
        if (pairs_.mixed(p))
            std::tie(toughness[p], driving[p]) = pair(p).damaging(local(jump, p));
        else if (pairs_.law[p] != nullptr)
            driving[p] = driving_energy(pairs_, p, jump).total();
    }
    return damage_at(pairs_, toughness, driving, before_.adhesion, adhesion);
}

bool VariationalIncrement::displace(const DisplacementSolve& solve, State& state) const {
    if (const CurvedDisplacement curved(pairs_, state.adhesion, state.mixity); !curved.plain())
        return curved.run(solve, state.closed, state.response);
    return solve(spring_stiffness(pairs_, state.adhesion), {}, state.closed, state.response);
}

// A pair that is partly damaged has a traction besides its spring, whether or not it damages further.
bool VariationalIncrement::damages(std::size_t p, double adhesion, std::span<const double> local_jump,
                                   double nearly) const {
    return before_.adhesion[p] < 1.0 || StepRule::damages(p, adhesion, local_jump, nearly);
}

PairMinimum VariationalIncrement::minimum(std::size_t p, std::span<const double> local_jump) const {
    if (!pairs_.mixed(p)) return StepRule::minimum(p, local_jump);
    const VariationalPair own = pair(p);
    const double zeta = own.minimiser(local_jump, before_.adhesion[p]);
    return {zeta, own.energy(local_jump, zeta)};
}

// The force of the model is C j - h, that of the pair at its own jump j.
PairModel VariationalIncrement::model(std::size_t p, std::span<const double> local_jump, double adhesion,
                                      double fraction) const {
    if (!pairs_.mixed(p)) return StepRule::model(p, local_jump, adhesion, fraction);
    const std::size_t dim = local_jump.size();
    const VariationalPair own = pair(p);
    const double weight = pairs_.weight[p];
    std::array<double, 9> c{};
    if (fraction > 0.0) {
        c = own.tangent(local_jump, before_.adhesion[p]);
    } else {
        const Law& law = *pairs_.law[p];
        const double scale = adhesion + own.proximal(local_jump, adhesion);
        for (std::size_t r = 0; r < dim; ++r) c[r * dim + r] = scale * law.stiffness(r);
    }
    const std::array<double, 3> force = own.force(local_jump, adhesion);
    PairModel m;
    for (std::size_t r = 0; r < dim; ++r) {
        m.force[r] -= weight * force[r];
        for (std::size_t q = 0; q < dim; ++q) {
            m.tangent[r * dim + q] = weight * c[r * dim + q];
            m.force[r] += weight * c[r * dim + q] * local_jump[q];
        }
    }
    return m;
}

double VariationalIncrement::cost(const PairMixities& mixity, std::span<const double> adhesion) const {
    return dissipation_linear(pairs_, mixity, before_.adhesion, adhesion) + stored_linear(pairs_, mixity, adhesion);
}

PairMixities VariationalIncrement::shown(std::span<const double> jump, PairMixities mixity) const {
    return mixities(pairs_, jump, mixity);
}

// The dissipation that is minimised has the mixity of the state before.
void VariationalIncrement::record_rule(State& next, double energy_change_linear) const {
    Ledger& ledger = next.ledger;
    const double dissipated = dissipation_linear(pairs_, next.mixity_before, before_.adhesion, next.adhesion);
    const PairMixities& last = before_.loaded != 0 ? before_.mixity_before : next.mixity_before;
    ledger.dissipated_linear = before_.ledger.dissipated_linear + dissipated;
    ledger.increment = energy_change_linear + dissipated;
    ledger.increment_lower = energy_change_linear + dissipation_linear(pairs_, last, before_.adhesion, next.adhesion);
}

std::vector<PairDirection> VariationalIncrement::directions(const State& state) const {
    if (!pairs_.gradient.empty())
        fail(DELAM_ERROR_STATE, "step tangent: not available for mixity_rule = variational with a gradient term");
    return beside_springs(state, false);
}

std::vector<PairDirection> VariationalIncrement::held_directions(const State& state) const {
    return beside_springs(state, true);
}

// Returns the force of each partly damaged pair, less that of its spring, component by component. held: the adhesion is
// fixed; otherwise the damage follows the jump.
std::vector<PairDirection> VariationalIncrement::beside_springs(const State& state, bool held) const {
    const std::size_t dim = dimension();
    const double largest = largest_driving(pairs_, state.response.jump);
    const std::vector<double> spring = spring_stiffness(pairs_, state.adhesion);
    std::vector<PairDirection> found;
    for (std::size_t p = 0; p < state.adhesion.size(); ++p) {
        if (!pairs_.mixed(p) || !(state.adhesion[p] > 0.0)) continue;
        const Law& law = *pairs_.law[p];
        const double before = state.mixity_before[p].shear;
        const VariationalPair own{law, before, law.toughness(before).total, largest};
        const std::span<const double> jump = local(state.response.jump, p);
        const std::array<double, 9> tangent =
            held ? own.tangent_held(jump, state.adhesion[p]) : own.tangent(jump, before_.adhesion[p]);
        const std::size_t first = state.closed[p] != 0 ? 1 : 0;
        for (std::size_t r = first; r < dim; ++r) {
            PairDirection direction{p, std::vector<double>(dim, 0.0), std::vector<double>(dim, 0.0), 1.0};
            direction.force[r] = 1.0;
            double size = 0.0;
            for (std::size_t c = first; c < dim; ++c) {
                direction.form[c] = pairs_.weight[p] * tangent[r * dim + c] - (c == r ? spring[p * dim + r] : 0.0);
                size = std::max(size, std::abs(direction.form[c]));
            }
            if (size > same_as_spring * spring[p * dim + r]) found.push_back(std::move(direction));
        }
    }
    return found;
}

}  // namespace delam
