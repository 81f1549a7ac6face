// SPDX-License-Identifier: BSD-3-Clause
// Measures how far a part of a load step has damaged the interfaces, by the area that has been dissipated,
// a = sum w g/Gc: the adhesion of a stiff interface tells little of it.
#pragma once

#include <span>

#include "evolution/increment/state.hpp"
#include "evolution/search/fronts.hpp"

namespace delam {

// Sizes, L or L2, of the interface on which most has been dissipated.
struct Advance {
    double area = 0.0;    // that has been dissipated
    double row = 0.0;     // of the pairs on the fronts that advance most, next to pairs whose toughness is spent;
                          // without fronts, of the pairs that lose most
    bool fronts = false;  // there are such fronts
    bool met = false;     // nothing adheres any more where most was dissipated: fronts have met, or reached an end
    double zone = 0.0;    // of all pairs that were damaged
    double whole = 0.0;   // of the interface, as far as it adhered at first
};
// initial: the adhesion at first, [pairs].
Advance advance_between(const PairLaws& pairs, const PairGraph& graph, std::span<const double> initial,
                        const State& before, const State& after);

// Returns the factor on the load, and with it on the jumps, at which the first pair meets its threshold; 1: some do.
double load_margin(const PairLaws& pairs, const State& state);

}  // namespace delam
