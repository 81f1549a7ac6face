// SPDX-License-Identifier: BSD-3-Clause
// How far a part of a load step has damaged the interfaces, and how much more load it has needed. The measure of damage
// is the area that has been dissipated, a = sum w g/Gc: the adhesion of a stiff interface tells little of it. The
// measure of the load is M with E = M^2 / 2 at fixed damage, the norm of the energy; where all loads grow in
// proportion, it is their factor.
#pragma once

#include <span>

#include "evolution/increment/state.hpp"
#include "evolution/search/fronts.hpp"

namespace delam {

// Of the interface on which most has been dissipated; L or L2.
struct Advance {
    double area = 0.0;  // that has been dissipated
    double row = 0.0;  // of the pairs on the fronts, next to pairs whose toughness is spent; of one pair without fronts
    double zone = 0.0;   // of all pairs that were damaged
    double whole = 0.0;  // of the interface, as far as it adhered at first
};
// initial: the adhesion at first, [pairs].
Advance advance_between(const PairLaws& pairs, const PairGraph& graph, std::span<const double> initial,
                        const State& before, const State& after);

// Returns ln M of the state after over the state before; infinity where the energy at fixed damage does not tell it.
double load_rise(const State& before, const State& after);
// Returns the factor on the load, and with it on the jumps, at which the first pair meets its threshold; 1: some do.
double load_margin(const PairLaws& pairs, const State& state);
// Returns the smallest pair as a part of its interface.
double smallest_share(const PairLaws& pairs, const PairGraph& graph, std::span<const double> initial);

}  // namespace delam
