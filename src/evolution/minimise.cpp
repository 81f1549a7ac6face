// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/minimise.hpp"

#include <algorithm>
#include <cmath>

namespace delam {

bool Minimiser::displace(State& state) const {
    const std::vector<double> stiffness = spring_stiffness(pairs, state.adhesion);
    const ContactResult contact_result = solve_contact(op, contact, stiffness, state.theta, state.closed, state.response);
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
    bool converged = true;
    while (true) {
        monitor.progress("minimise", state.counts.am_iterations, 0);
        converged = displace(state) && converged;
        const std::vector<double> next = damage_step(pairs, state.mixity, adhesion_old, state.response.jump);
        double change = 0.0;
        for (std::size_t p = 0; p < next.size(); ++p) change = std::max(change, std::abs(next[p] - state.adhesion[p]));
        state.adhesion = next;
        state.counts.damage_change = change;
        ++state.counts.am_iterations;
        const bool fixed_point = change <= tolerance;
        if (!fixed_point && state.counts.am_iterations < limit) continue;
        if (change > 0.0) converged = displace(state) && converged;
        return converged && fixed_point;
    }
}

}  // namespace delam
