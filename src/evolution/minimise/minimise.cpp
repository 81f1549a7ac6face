// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/minimise/minimise.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/error.hpp"
#include "delam/delam.h"
#include "evolution/contact/extrapolation.hpp"
#include "evolution/minimise/zone_newton.hpp"

namespace delam {

namespace {

// Newton's method runs in the zone as long as each round brings the bodies nearer to their fixed point. Where a round
// does not, and the change of the adhesion is within the rounding of the zone, alternations with the bodies go on.
class ZoneProgress {
public:
    explicit ZoneProgress(double zone_rounding) : rounding_(zone_rounding) {}
    bool use(double change) {
        if (change > rounding_)
            spent_ = false;
        else if (change > 0.5 * before_)
            spent_ = true;
        before_ = change;
        return !spent_;
    }

private:
    double rounding_;
    double before_ = INFINITY;  // the change of the round before
    bool spent_ = false;
};

// Tells whether the damage is at rest: the change of a round is within the tolerance, or rounds no longer come nearer
// and the change is within what the solves have left open. (An operator that iterates begins from the last answer, and
// its next one differs by rounding. With a tolerance below that, the scheme would end by chance.)
class AtRest {
public:
    // most_idle: rounds that do not halve the least change.
    AtRest(double tolerance, std::int64_t most_idle) : tolerance_(tolerance), most_idle_(most_idle) {}
    bool operator()(double change, double blur) {
        idle_ = change < 0.5 * least_ ? 0 : idle_ + 1;
        least_ = std::min(least_, change);
        return change <= tolerance_ || (idle_ >= most_idle_ && change <= blur);
    }

private:
    double tolerance_;
    std::int64_t most_idle_;
    double least_ = INFINITY;
    std::int64_t idle_ = 0;
};

}  // namespace

bool Minimiser::displace(State& state, const Increment& increment, bool cold) const {
    const auto solve = [&](std::span<const double> stiffness, std::span<const double> row_force,
                           std::vector<std::uint8_t>& closed, Response& response) {
        const ContactResult result =
            solve_contact(op, contact, stiffness, state.theta, closed, response, cold, row_force, places);
        Effort one;
        one.displacement_solves = 1;
        one.contact_iterations = one.contact_iterations_first = one.contact_iterations_max = result.solves;
        one.contact_fallbacks = result.fallback ? 1 : 0;
        one.linear_iterations = result.linear_iterations;
        one.linear_residual = result.linear_residual;
        state.effort.add(one);
        return result.converged;
    };
    return increment.displace(solve, state);
}

bool Minimiser::end(State& state, const StepRule& increment, bool converged) const {
    increment.record(state);
    return converged && increment.held() == 0;
}

bool Minimiser::alternate(State& state, StepRule& increment, bool displaced) const {
    const std::int64_t last = state.effort.am_iterations + limit;
    AtRest at_rest(tolerance, limits.minimise_most_idle);
    while (true) {
        monitor.progress("minimise", state.effort.am_iterations, 0);
        const bool converged = std::exchange(displaced, false) || displace(state, increment);
        increment.observe(state.adhesion, state.response.jump);
        std::vector<double> next = increment.damage_step(state.adhesion, state.response.jump);
        state.outcome.damage_change = increment.change(state.adhesion, next, state.response.jump);
        ++state.effort.am_iterations;
        if (at_rest(state.outcome.damage_change, increment.blur(state, next)) && increment.settled(state))
            return end(state, increment, converged);
        state.adhesion = std::move(next);
        if (state.effort.am_iterations < last) continue;
        displace(state, increment);
        return end(state, increment, false);
    }
}

double Minimiser::energy(const State& state, const Increment& increment) const {
    return state.response.stored_bulk + state.response.load_potential +
           increment.energy(state.adhesion, state.response.jump);
}

void Minimiser::extrapolate(State& state, const StepRule& increment, std::span<const double> plain,
                            Extrapolation& extrapolation) const {
    const std::vector<double> from = state.adhesion;
    state.adhesion = extrapolation.next(from, plain);
    double along = 0.0;
    for (std::size_t p = 0; p < plain.size(); ++p) {
        state.adhesion[p] = std::clamp(state.adhesion[p], increment.least(p), increment.adhesion_before()[p]);
        along += (state.adhesion[p] - from[p]) * (plain[p] - from[p]);
    }
    if (along > 0.0) return;
    // Where plain steps grow, the fixed point of the extrapolation lies behind them.
    state.adhesion.assign(plain.begin(), plain.end());
    extrapolation.forget();
}

// Each round is one alternation, which is also the stopping test; between rounds the adhesion moves ahead. A move that
// raised the energy of the whole is taken back, and the plain step is made instead. Where the mixity follows the
// iterates, energies are compared at equal B: what a new B alone adds goes onto the level of comparison.
bool Minimiser::accelerate(State& state, StepRule& increment, bool displaced) const {
    const std::int64_t last = state.effort.am_iterations + limit;
    // Newton's method eliminates the damage pair by pair, which a gradient term forbids.
    Zones* const zones = increment.pairs().gradient.empty() ? op.zones() : nullptr;
    const ZoneNewton newton{
        op, zones, contact, monitor, limits, tolerance, std::min(limits.minimise_newton_steps, limit), lowest};
    ZoneProgress progress(zones != nullptr ? zones->zone_traits().rounding : 0.0);
    AtRest at_rest(tolerance, limits.minimise_most_idle);
    bool ahead = false;
    std::optional<State> before;
    std::optional<StepMixities::Memory> mixity_before;
    std::vector<double> plain;
    Extrapolation extrapolation;
    double level = 0.0;
    while (true) {
        monitor.progress("minimise", state.effort.am_iterations, 0);
        const bool converged = std::exchange(displaced, false) || displace(state, increment);
        const double reached = energy(state, increment);
        if (!std::isfinite(reached)) fail(DELAM_ERROR_NUMERICAL, "the energy of a displacement step is not finite");
        if (ahead && reached > level + limits.minimise_energy_rounding * std::abs(level)) {
            const Effort effort = state.effort;
            state = std::move(*before);
            state.effort = effort;
            state.adhesion = plain;
            increment.restore(*mixity_before);
            ahead = false;
            extrapolation.forget();
            continue;
        }
        level = increment.observe(state.adhesion, state.response.jump) ? energy(state, increment) : reached;
        plain = increment.damage_step(state.adhesion, state.response.jump);
        state.outcome.damage_change = increment.change(state.adhesion, plain, state.response.jump);
        ++state.effort.am_iterations;
        if (at_rest(state.outcome.damage_change, increment.blur(state, plain)) && increment.settled(state))
            return end(state, increment, converged);
        if (state.effort.am_iterations >= last) {
            state.adhesion = plain;
            displace(state, increment);
            return end(state, increment, false);
        }
        before = state;
        mixity_before = increment.memory();
        const bool in_zone = progress.use(state.outcome.damage_change) && zones != nullptr;
        if (const std::optional<double> added = in_zone ? newton.run(state, increment, increment) : std::nullopt) {
            level += *added;
            ahead = state.adhesion != before->adhesion;
            if (!ahead) state.adhesion = plain;
        } else {
            extrapolate(state, increment, plain, extrapolation);
            ahead = state.adhesion != plain;
        }
    }
}

}  // namespace delam
