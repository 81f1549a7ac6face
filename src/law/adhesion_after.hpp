// SPDX-License-Identifier: BSD-3-Clause
// Computes how far a point softens while it dissipates a given share of its toughness.
#pragma once

#include "law/law.hpp"

namespace delam {

// The adhesion zeta <= zeta_old with g(zeta) - g(zeta_old) = share Gc, 0 < share <= 1; 0 if hardly more than that is
// left, or if the law debonds at once on the way.
double adhesion_after(const Law& law, const Toughness& t, double zeta_old, double share);

}  // namespace delam
