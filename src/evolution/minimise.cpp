// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/minimise.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.hpp"
#include "delam/delam.h"
#include "evolution/extrapolation.hpp"
#include "evolution/zone_newton.hpp"

namespace delam {

namespace {

constexpr std::int64_t leap_steps = 1000;  // steps within the zone before the plain step looks at all pairs again
constexpr double rounding = 1e-12;  // of an energy of the whole scene, a sum of large terms

}  // namespace

bool Minimiser::displace(State& state, bool cold) const {
    const std::vector<double> stiffness = spring_stiffness(pairs, state.adhesion);
    const ContactResult contact_result = solve_contact(op, contact, stiffness, state.theta, state.closed, state.response, cold);
    Counts& counts = state.counts;
    if (counts.displacement_solves == 0) counts.contact_iterations_first = contact_result.solves;
    ++counts.displacement_solves;
    counts.contact_iterations += contact_result.solves;
    counts.contact_iterations_max = std::max(counts.contact_iterations_max, contact_result.solves);
    counts.contact_fallbacks += contact_result.fallback ? 1 : 0;
    counts.linear_iterations += contact_result.linear_iterations;
    counts.linear_residual = std::max(counts.linear_residual, contact_result.linear_residual);
    return contact_result.converged;
}

bool Minimiser::alternate(State& state, std::span<const double> adhesion_old) const {
    const std::vector<Toughness> toughness = toughnesses(pairs, state.mixity);
    bool converged = true;
    while (true) {
        monitor.progress("minimise", state.counts.am_iterations, 0);
        converged = displace(state);
        const std::vector<double> next = damage_step(pairs, toughness, adhesion_old, state.adhesion, state.response.jump);
        double change = 0.0;
        for (std::size_t p = 0; p < next.size(); ++p) change = std::max(change, std::abs(next[p] - state.adhesion[p]));
        state.counts.damage_change = change;
        ++state.counts.am_iterations;
        if (change <= tolerance) return converged;
        state.adhesion = next;
        if (state.counts.am_iterations < limit) continue;
        displace(state);
        return false;
    }
}

// E + D of a state whose displacements belong to its adhesion, up to a constant of the step.
double Minimiser::energy(const State& state, std::span<const double> adhesion_old) const {
    return state.response.stored_bulk + state.response.load_potential + stored_energy(pairs, state.adhesion, state.response.jump) +
           dissipation(pairs, state.mixity, adhesion_old, state.adhesion);
}

// Each round is a step of alternate minimisation, which is also the stopping test; between rounds the adhesion leaps ahead. A leap that raised
// the energy of the whole is taken back, and the plain step made instead.
bool Minimiser::accelerate(State& state, std::span<const double> adhesion_old) const {
    const std::vector<Toughness> toughness = toughnesses(pairs, state.mixity);
    // The leap eliminates the damage pair by pair, which a gradient term forbids.
    auto* condensed = pairs.gradient.empty() ? dynamic_cast<Condensed*>(&op) : nullptr;
    bool converged = true, leapt = false;
    std::optional<State> before;
    std::vector<double> plain;
    Extrapolation extrapolation;
    double level = 0.0;
    while (true) {
        monitor.progress("minimise", state.counts.am_iterations, 0);
        converged = displace(state);
        const double reached = energy(state, adhesion_old);
        if (!std::isfinite(reached)) fail(DELAM_ERROR_NUMERICAL, "the energy of a displacement step is not finite");
        if (leapt && reached > level + rounding * std::abs(level)) {
            const Counts counts = state.counts;
            state = std::move(*before);
            state.counts = counts;
            state.adhesion = plain;
            leapt = false;
            extrapolation.forget();
            continue;
        }
        level = reached;
        plain = damage_step(pairs, toughness, adhesion_old, state.adhesion, state.response.jump);
        double change = 0.0;
        for (std::size_t p = 0; p < plain.size(); ++p) change = std::max(change, std::abs(plain[p] - state.adhesion[p]));
        state.counts.damage_change = change;
        ++state.counts.am_iterations;
        if (change <= tolerance) return converged;
        if (state.counts.am_iterations >= limit) {
            state.adhesion = plain;
            displace(state);
            return false;
        }
        before = state;
        if (condensed == nullptr) {
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
        ZoneNewton{*condensed, pairs, contact, monitor, tolerance, std::min(leap_steps, limit)}.leap(state, toughness, adhesion_old);
        leapt = state.adhesion != before->adhesion;
        if (!leapt) state.adhesion = plain;
    }
}

}  // namespace delam
