// SPDX-License-Identifier: BSD-3-Clause
// Computes the energy that a pair dissipates between two states of a path. If the toughness depends on the mode, this
// is the integral of its threshold along the path, int h(B, zeta) (-dzeta) with h = -dg/dzeta, and no function of the
// two states: a pair that slides first and opens later dissipates more than one that does the reverse.
//
// The jump of the pair is interpolated: by the parabola through its values in the last three states, and otherwise by a
// straight line. Along it the pair follows its law, zeta = argmin of zeta Y + g(B, zeta), down to the adhesion that it
// reaches, and dissipates g(B, .) of each small part at the mixity B met there. The error falls with the third power of
// the change (straight: second).
#pragma once

#include <cstddef>
#include <span>

#include "evolution/increment/damage_step.hpp"

namespace delam {

// Energies of one pair, F/L.
struct PathEnergy {
    double dissipated = 0.0;
    double linear = 0.0;  // in the split of PANM 15 (2010): int Gc(B) (-dzeta)
    double error = 0.0;   // difference from an integral of the next lower order
};

// Local jumps [dimension] of a pair and its adhesions at two states of a path, and the jump at the state before these;
// empty: not known. A pair that has not been damaged yet comes from no jump.
struct PairPath {
    std::span<const double> last, from, to;
    double adhesion_from, adhesion_to;
};

// mixity: used where the jump defines none.
PathEnergy path_energy(const PairLaws& pairs, std::size_t pair, const PairPath& path, const Mixity& mixity);

// The mixity whose toughness is what an intact pair dissipates that comes from one jump and debonds by another.
Mixity path_mixity(const PairLaws& pairs, std::size_t pair, std::span<const double> from, std::span<const double> to,
                   const Mixity& mixity);

}  // namespace delam
