// SPDX-License-Identifier: BSD-3-Clause
// Watches an analysis with small rotations for the step in which these leave out too much (kinematics = auto).
//
// At fixed damage and contact rotations and stresses are in proportion to the loads; the energy that small rotations
// leave out grows with the square of the rotations, and critical stresses fall with the square of the length of a strip
// that has come off. So a measure is computed only where loads, damage or contact differ so much from those for which
// it was known last that it may have come half of the way from there to what counts.
//
// Two things cost a factorisation of all bodies, more than most steps do: the critical stresses, and how far further
// displacements relieve the strains of rotations. The latter is computed only where the energy of these strains counts
// before any relief, and may count with the relief that is known.
#pragma once

#include <string>

#include "evolution/increment/state.hpp"
#include "evolution/observe/observer.hpp"

namespace delam {

// Returns what small rotations leave out of `next`, which the observer shows, in words; empty: nothing that counts. The
// state keeps the measures that are known, those of `before` where they need not be computed.
std::string judge_rotations(Observer& observer, const State& before, State& next);

}  // namespace delam
