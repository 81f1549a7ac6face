// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/step/minimise.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.hpp"
#include "delam/delam.h"
#include "evolution/increment/curved_displacement.hpp"
#include "evolution/increment/extrapolation.hpp"
#include "evolution/step/zone_newton.hpp"

namespace delam {

namespace {

constexpr std::int64_t leap_steps = 1000;  // steps within the zone before the plain step looks at all pairs again
constexpr double rounding = 1e-11;         // of an energy of the whole scene, a sum of large terms

double largest_change(std::span<const double> from, std::span<const double> to) {
    double change = 0.0;
    for (std::size_t p = 0; p < to.size(); ++p) change = std::max(change, std::abs(to[p] - from[p]));
    return change;
}

}  // namespace

bool Minimiser::displace(State& state, bool cold) const {
    Counts& counts = state.counts;
    const auto solve = [&](std::span<const double> stiffness, std::span<const double> row_force,
                           std::vector<std::uint8_t>& closed, Response& response) {
        const ContactResult result =
            solve_contact(op, contact, stiffness, state.theta, closed, response, cold, row_force);
        if (counts.displacement_solves == 0) counts.contact_iterations_first = result.solves;
        ++counts.displacement_solves;
        counts.contact_iterations += result.solves;
        counts.contact_iterations_max = std::max(counts.contact_iterations_max, result.solves);
        counts.contact_fallbacks += result.fallback ? 1 : 0;
        counts.linear_iterations += result.linear_iterations;
        counts.linear_residual = std::max(counts.linear_residual, result.linear_residual);
        return result.converged;
    };
    if (rule == MixityRule::variational)
        if (const CurvedDisplacement curved(pairs, state.adhesion, state.mixity); !curved.plain())
            return curved.run(solve, state.closed, state.response);
    return solve(spring_stiffness(pairs, state.adhesion), {}, state.closed, state.response);
}

// What every way to minimise leaves in the state.
bool Minimiser::record(State& state, std::span<const double> adhesion_old, const StepMixity& mixity,
                       bool converged) const {
    state.mixity = mixity.recorded();
    state.ledger.mixity_error = mixity.error(adhesion_old, state.adhesion);
    state.counts.mixity_held = mixity.held();
    return converged && mixity.held() == 0;
}

bool Minimiser::alternate(State& state, std::span<const double> adhesion_old) const {
    StepMixity mixity(pairs, rule, tolerance, state.mixity);
    while (true) {
        monitor.progress("minimise", state.counts.am_iterations, 0);
        const bool converged = displace(state);
        mixity.look(state.adhesion, state.response.jump);
        std::vector<double> next = mixity.damage_step(adhesion_old, state.adhesion, state.response.jump);
        state.counts.damage_change = largest_change(state.adhesion, next);
        ++state.counts.am_iterations;
        if (state.counts.damage_change <= tolerance && mixity.settled(state, adhesion_old))
            return record(state, adhesion_old, mixity, converged);
        state.adhesion = std::move(next);
        if (state.counts.am_iterations < limit) continue;
        displace(state);
        return record(state, adhesion_old, mixity, false);
    }
}

// E + D of a state whose displacements belong to its adhesion, up to a constant of the step.
double Minimiser::energy(const State& state, std::span<const double> adhesion_old, const StepMixity& mixity) const {
    return state.response.stored_bulk + state.response.load_potential +
           mixity.energy(adhesion_old, state.adhesion, state.response.jump);
}

// Each round is a step of alternate minimisation, which is also the stopping test; between rounds the adhesion leaps
// ahead. A leap that raised the energy of the whole is taken back, and the plain step made instead. Where the mixity
// follows the iterate, energies are compared at equal B: what a new B alone adds goes onto the level that is compared
// with.
bool Minimiser::accelerate(State& state, std::span<const double> adhesion_old) const {
    StepMixity mixity(pairs, rule, tolerance, state.mixity);
    // Newton's method eliminates the damage pair by pair, which a gradient term forbids.
    const bool by_newton = pairs.gradient.empty() && op.offers_zone();
    bool leapt = false;
    std::optional<State> before;
    std::optional<StepMixity::Memory> mixity_before;
    std::vector<double> plain;
    Extrapolation extrapolation;
    double level = 0.0;
    while (true) {
        monitor.progress("minimise", state.counts.am_iterations, 0);
        const bool converged = displace(state);
        const double reached = energy(state, adhesion_old, mixity);
        if (!std::isfinite(reached)) fail(DELAM_ERROR_NUMERICAL, "the energy of a displacement step is not finite");
        if (leapt && reached > level + rounding * std::abs(level)) {
            const Counts counts = state.counts;
            state = std::move(*before);
            state.counts = counts;
            state.adhesion = plain;
            mixity.restore(*mixity_before);
            leapt = false;
            extrapolation.forget();
            continue;
        }
        level = mixity.look(state.adhesion, state.response.jump) ? energy(state, adhesion_old, mixity) : reached;
        plain = mixity.damage_step(adhesion_old, state.adhesion, state.response.jump);
        state.counts.damage_change = largest_change(state.adhesion, plain);
        ++state.counts.am_iterations;
        if (state.counts.damage_change <= tolerance && mixity.settled(state, adhesion_old))
            return record(state, adhesion_old, mixity, converged);
        if (state.counts.am_iterations >= limit) {
            state.adhesion = plain;
            displace(state);
            return record(state, adhesion_old, mixity, false);
        }
        before = state;
        mixity_before = mixity.memory();
        std::optional<double> added;
        if (by_newton)
            added = ZoneNewton{op, pairs, contact, monitor, tolerance, std::min(leap_steps, limit)}.leap(state, mixity,
                                                                                                         adhesion_old);
        if (!added) {
            state.adhesion = extrapolation.next(state.adhesion, plain);
            // Where plain steps grow, the fixed point that extrapolation aims at lies behind them.
            double along = 0.0;
            for (std::size_t p = 0; p < plain.size(); ++p) {
                state.adhesion[p] = std::clamp(state.adhesion[p], 0.0, adhesion_old[p]);
                along += (state.adhesion[p] - before->adhesion[p]) * (plain[p] - before->adhesion[p]);
            }
            if (!(along > 0.0)) {
                state.adhesion = plain;
                extrapolation.forget();
            }
            leapt = state.adhesion != plain;
            continue;
        }
        level += *added;
        leapt = state.adhesion != before->adhesion;
        if (!leapt) state.adhesion = plain;
    }
}

}  // namespace delam
