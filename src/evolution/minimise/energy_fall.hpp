// SPDX-License-Identifier: BSD-3-Clause
// Tells where the energy of bodies that buckle falls to along a mode, at fixed loads and adhesion.
//
// The mode has two directions. Faces decide first: the bodies go where faces that touch open. Else the energy does,
// where it falls further. Where it falls alike (a symmetric scene, which has two states of equal energy), the sign of
// orient() stays: no rounding decides.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "evolution/increment/damage_step.hpp"
#include "evolution/increment/state.hpp"
#include "reduction/turned/turned_operator.hpp"

namespace delam {

struct EnergyFall {
    std::vector<double> displacement;  // [mesh DOFs] the lowest of those compared
    double energy = 0.0;               // stored energy and load potential of it, F L
    bool penetrates = false;           // faces pass through each other
};

// state: in balance. Nothing: the energy falls in neither direction.
std::optional<EnergyFall> energy_fall(const TurnedOperator& op, const PairLaws& pairs, const State& state,
                                      std::span<const double> mode);

// Returns the share of a move from these displacements at which the energy of a state, at its adhesion, is lowest:
// among halves and doubles of it, and on a parabola through the lowest three.
double lowest_share(const TurnedOperator& op, const PairLaws& pairs, const State& state,
                    std::span<const double> displacement, std::span<const double> move);

}  // namespace delam
