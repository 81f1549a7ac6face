// SPDX-License-Identifier: BSD-3-Clause
// The bilinear law in energetic form: traction falls on a straight line from the onset to zero.
//
//   g(zeta) = Gc Go (1-zeta) / (Go + D zeta),  f(zeta) = -Gc D zeta (1-zeta) / (Go + D zeta),  D = Gc - Go
//   Y(zeta) = -g' = Go (Gc/(Go + D zeta))^2
//   minimiser of zeta Y + g:  zeta = clamp((Gc sqrt(Go/Y) - Go) / D, 0, zeta_old)
//
// D = 0 is Griffith's law: g = Gc (1-zeta), zeta_old while Y < Gc, else 0.
#pragma once

#include "law/softening/law_kind.hpp"
#include "law/softening/toughness.hpp"

namespace delam {

struct LinearSoftening {
    static constexpr LawKind kind{"piecewise-linear", "the bilinear law: traction falls on a straight line",
                                  Toughnesses::onset_and_total};

    double dissipated(const Toughness& t, double zeta) const;
    double stored_linear(const Toughness& t, double zeta) const;
    double driving(const Toughness& t, double zeta) const;
    double driving_slope(const Toughness& t, double zeta) const;
    double minimiser(const Toughness& t, double driving, double zeta_old) const;
    double slope(const Toughness& t, double driving, double zeta_old) const;
    // dg/dGc at the same Go and zeta: 0 at zeta = 1, 1 at zeta = 0.
    double total_share(const Toughness& t, double zeta) const;
};

}  // namespace delam
