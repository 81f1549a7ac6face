// SPDX-License-Identifier: BSD-3-Clause
#include "law/softening/linear_softening.hpp"

#include <algorithm>
#include <cmath>

namespace delam {

double LinearSoftening::dissipated(const Toughness& t, double zeta) const {
    return t.total * ((1.0 - zeta) * (t.onset / (t.onset * (1.0 - zeta) + t.total * zeta)));
}

double LinearSoftening::stored_linear(const Toughness& t, double zeta) const {
    return -(t.total - t.onset) * (zeta * (1.0 - zeta) * (t.total / (t.onset * (1.0 - zeta) + t.total * zeta)));
}

double LinearSoftening::driving(const Toughness& t, double zeta) const {
    const double share = t.total / (t.onset * (1.0 - zeta) + t.total * zeta);
    return t.onset * share * share;
}

double LinearSoftening::driving_slope(const Toughness& t, double zeta) const {
    return -2.0 * ((t.total - t.onset) / (t.onset * (1.0 - zeta) + t.total * zeta)) * driving(t, zeta);
}

// With s = sqrt(Go/Y) the stationary point (Gc s - Go)/D is a difference of close numbers over a small one when D is
// small beside Go. Multiplied by Gc s + Go it becomes
//
//     zeta = (Gc^2/Go - Y) Go^2 / (D Y (Gc s + Go)),     Gc^2/Go - Y = (Gc - Y) + Gc D/Go,
//
// in which the only difference, Gc - Y, is exact where it matters. Written in multiples of Go, independent of units.
double LinearSoftening::minimiser(const Toughness& t, double driving, double zeta_old) const {
    const double d = (t.total - t.onset) / t.onset;
    if (!(d > 0.0)) return driving < t.total ? zeta_old : 0.0;
    if (driving <= t.onset) return zeta_old;
    const double total = t.total / t.onset;
    const double y = driving / t.onset;
    const double beyond = (t.total - driving) / t.onset + total * d;
    if (!(beyond > 0.0)) return 0.0;
    return std::min(zeta_old, beyond / (d * y * (total / std::sqrt(y) + 1.0)));
}

// zeta = (Gc sqrt(Go/Y) - Go)/D on the softening branch.
double LinearSoftening::slope(const Toughness& t, double driving, double zeta_old) const {
    const double zeta = minimiser(t, driving, zeta_old);
    if (!(zeta > 0.0 && zeta < zeta_old)) return 0.0;
    return -0.5 * t.total * std::sqrt(t.onset / driving) / ((t.total - t.onset) * driving);
}

double LinearSoftening::total_share(const Toughness& t, double zeta) const {
    const double softened = t.onset * (1.0 - zeta) / (t.onset * (1.0 - zeta) + t.total * zeta);
    return softened * softened;
}

}  // namespace delam
