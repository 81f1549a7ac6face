// SPDX-License-Identifier: BSD-3-Clause
// Traction falls exponentially after the onset. With x = sqrt(Y/Go), the jump over that of the onset, and s the
// traction over its peak,
//
//   s = exp(-(x-1)/lambda),  zeta = s/x,  lambda = (Gc/Go - 1)/2,
//
// so that the area under s beyond x = 1 is lambda. The energy dissipated up to (x, s), with unloading along its ray, is
//
//   g = Go [1 + 2 lambda (1-s) - s x].
//
// Adhesion never reaches 0: Y(0) and its slope are infinite. lambda = 0 is Griffith's law.
#pragma once

#include "law/softening/law_kind.hpp"
#include "law/softening/toughness.hpp"

namespace delam {

struct ExponentialSoftening {
    static constexpr LawKind kind{"exponential",
                                  "traction decays over (Gc/Go - 1)/2 of the jump at the onset and never reaches zero",
                                  Toughnesses::onset_and_total};

    double dissipated(const Toughness& t, double zeta) const;
    double driving(const Toughness& t, double zeta) const;
    double driving_slope(const Toughness& t, double zeta) const;
    double minimiser(const Toughness& t, double driving, double zeta_old) const;
    double slope(const Toughness& t, double driving, double zeta_old) const;
    double total_share(const Toughness& t, double zeta) const;  // dg/dGc at the same Go and zeta
};

}  // namespace delam
