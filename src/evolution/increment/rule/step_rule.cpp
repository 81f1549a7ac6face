// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/increment/rule/step_rule.hpp"

#include <algorithm>
#include <cmath>

#include "law/mixity.hpp"

namespace delam {

namespace {

// SolveError is ten times what a further step of an iteration would change (body_solver.hpp).
constexpr double further_step = 0.1;
// Share of its toughness that a pair may lose in a step that damages gradually.
constexpr double gradual = 0.1;

}  // namespace

StepRule::StepRule(const PairLaws& pairs, const State& before, const PairMixities& mixity, StepLimits limits,
                   const StepRule* like)
    : Increment(pairs, before), limits_(limits) {
    now_.used = mixity;
    now_.own = now_.used;
    if (like == nullptr) {
        now_.toughness = toughnesses(pairs, mixity);
        return;
    }
    now_.toughness = like->now_.toughness;
    for (std::size_t p = 0; p < mixity.size(); ++p)
        if (pairs.mixed(p) && mixity[p] != like->now_.used[p]) now_.toughness[p] = pairs.toughness(p, mixity[p]);
}

bool StepRule::damages(std::size_t pair, double adhesion, std::span<const double> local_jump, double nearly) const {
    const Law& law = *pairs_.law[pair];
    const double before = before_.adhesion[pair];
    return adhesion < before ||
           law.minimiser(now_.toughness[pair], driving_energy(law, local_jump).total() / nearly, before) < before;
}

PairMinimum StepRule::minimum(std::size_t pair, std::span<const double> local_jump) const {
    const Law& law = *pairs_.law[pair];
    const double driving = driving_energy(law, local_jump).total();
    const double zeta = bounded(pair, law.minimiser(now_.toughness[pair], driving, before_.adhesion[pair]));
    return {zeta, zeta * driving + law.dissipated(now_.toughness[pair], zeta)};
}

// C = w [zeta K + fraction zeta'(Y) (K j)(K j)^T],   h = C j - w zeta K j.
PairModel StepRule::model(std::size_t pair, std::span<const double> local_jump, double adhesion,
                          double fraction) const {
    const std::size_t dim = local_jump.size();
    const Law& law = *pairs_.law[pair];
    const double weight = pairs_.weight[pair];
    double pull[3] = {law.stiffness(0) * std::max(0.0, local_jump[0]), 0.0, 0.0};
    for (std::size_t c = 1; c < dim; ++c) pull[c] = law.stiffness(c) * local_jump[c];
    const double driving = driving_energy(law, local_jump).total();
    const bool follows =
        fraction > 0.0 && law.minimiser(now_.toughness[pair], driving, before_.adhesion[pair]) > least(pair);
    const double slope = follows ? fraction * law.slope(now_.toughness[pair], driving, before_.adhesion[pair]) : 0.0;
    PairModel m;
    for (std::size_t r = 0; r < dim; ++r)
        for (std::size_t q = 0; q < dim; ++q) {
            const double spring = weight * adhesion * law.stiffness(r);
            const double secant = r == q ? spring : 0.0;
            const double full = weight * slope * pull[r] * pull[q] + secant;
            m.tangent[r * dim + q] = full;
            if (full != 0.0) m.force[r] += (full - secant) * local_jump[q];
        }
    return m;
}

double StepRule::dissipated(std::size_t pair, double adhesion) const {
    const Law& law = *pairs_.law[pair];
    const Toughness& t = now_.toughness[pair];
    return law.dissipated(t, adhesion) - law.dissipated(t, before_.adhesion[pair]);
}

double StepRule::left(std::size_t pair, double adhesion) const {
    const Toughness& t = now_.toughness[pair];
    return 1.0 - pairs_.law[pair]->dissipated(t, adhesion) / t.total;
}

double StepRule::change(std::size_t pair, double from, double to, double driving) const {
    const double onset = now_.toughness[pair].onset;
    return std::abs(to - from) * (driving > onset ? std::sqrt(driving / onset) : 1.0);
}

double StepRule::change(std::span<const double> from, std::span<const double> to, std::span<const double> jump) const {
    double largest = 0.0;
    for (std::size_t p = 0; p < to.size(); ++p)
        if (from[p] != to[p])
            largest = std::max(largest, change(p, from[p], to[p], driving_energy(pairs_, p, jump).total()));
    return largest;
}

// Each jump becomes longer by what a further step of the solve would change.
double StepRule::blur(const State& state, std::span<const double> damage) {
    const double open = further_step * state.response.error.jump;
    blur_ = 0.0;
    if (!(open > 0.0)) return blur_;
    std::vector<double> jump = state.response.jump;
    const std::size_t dim = dimension();
    for (std::size_t p = 0; p < state.adhesion.size(); ++p) {
        const std::span<double> own = std::span(jump).subspan(p * dim, dim);
        double square = 0.0;
        for (const double j : own) square += j * j;
        if (!(square > 0.0)) continue;
        for (double& j : own) j *= 1.0 + open / std::sqrt(square);
    }
    blur_ = change(damage, damage_step(state.adhesion, jump), state.response.jump);
    return blur_;
}

bool StepRule::observe(std::span<const double> adhesion, std::span<const double> jump) {
    largest_ = largest_driving(pairs_, jump);
    begin_observation();
    bool changed = false;
    for (std::size_t p = 0; p < adhesion.size(); ++p)
        if (pairs_.mixed(p) && adhesion[p] > 0.0 && observe(p, driving_energy(pairs_, p, jump))) changed = true;
    return changed;
}

bool StepRule::observe(std::size_t pair, const Driving& y) {
    if (pairs_.mixed(pair) && tells_mixity(*pairs_.law[pair], y, largest_)) now_.own.set(pair, y.mixity());
    return false;
}

// mixity_error = sum w |dzeta| |Gc(own) - Gc(used)| / sum w |dzeta| Gc(used); 0 when nothing was damaged.
void StepRule::record(State& state) const {
    double missed = 0.0, all = 0.0;
    for (std::size_t p = 0; p < state.adhesion.size(); ++p) {
        if (pairs_.law[p] == nullptr || state.adhesion[p] == before_.adhesion[p]) continue;
        const double part = pairs_.weight[p] * std::abs(before_.adhesion[p] - state.adhesion[p]);
        const double total = now_.toughness[p].total;
        all += part * total;
        if (pairs_.mixed(p)) missed += part * std::abs(pairs_.law[p]->toughness(now_.own[p]).total - total);
    }
    state.mixity = recorded();
    state.ledger.mixity_error = all > 0.0 ? missed / all : 0.0;
    state.outcome.mixity_held = held();
}

void StepRule::restore(const Memory& memory) { now_ = memory; }

void record_energies(const PairLaws& pairs, State& state) {
    Ledger& ledger = state.ledger;
    ledger.stored_bulk = state.response.stored_bulk;
    ledger.load_potential = state.response.load_potential;
    ledger.stored_interface = stored_energy(pairs, state.adhesion, state.response.jump);
    ledger.stored_interface_linear = ledger.stored_interface + stored_linear(pairs, state.mixity, state.adhesion);
}

bool damages_abruptly(const Increment& step, std::span<const double> adhesion) {
    const std::vector<double>& before = step.adhesion_before();
    for (std::size_t p = 0; p < before.size(); ++p)
        if (step.pairs().law[p] != nullptr && adhesion[p] < before[p] &&
            step.left(p, before[p]) - step.left(p, adhesion[p]) > gradual)
            return true;
    return false;
}

void StepRule::record_ledger(State& next, const Dissipation* along) const {
    record_energies(pairs_, next);
    Ledger& ledger = next.ledger;
    const double dissipated =
        along != nullptr ? along->recorded : dissipation(pairs_, next.mixity, before_.adhesion, next.adhesion);
    ledger.dissipated = before_.ledger.dissipated + dissipated;
    const double change = ledger.energy() - before_.ledger.energy();
    ledger.increment = change + dissipated;
    if (along != nullptr) {
        ledger.increment_lower = ledger.increment;
        ledger.dissipated_linear = before_.ledger.dissipated_linear + along->linear;
        ledger.mixity_error = dissipated > 0.0 ? along->error / dissipated : 0.0;
        return;
    }
    ledger.increment_lower = change + dissipation(pairs_, next.mixity_before, before_.adhesion, next.adhesion);
    record_rule(next, ledger.energy_linear() - before_.ledger.energy_linear());
}

}  // namespace delam
