// SPDX-License-Identifier: BSD-3-Clause
#include "law/softening/exponential_softening.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace delam {

namespace {

double decay_length(const Toughness& t) { return 0.5 * ((t.total - t.onset) / t.onset); }

// Place on the curve at which the adhesion is zeta: x - 1, and its share w = (x-1)/lambda of the decay length, s =
// exp(-w).
struct Place {
    double beyond;
    double decays;
};

// With v = ln x the curve zeta = s/x reads
//
//     (exp(v) - 1)/lambda + v = -ln zeta,
//
// convex and increasing in v, so Newton's method started right of the root decreases towards it and never passes it.
// Either term alone bounds v.
Place place_of(double lambda, double zeta) {
    const double logarithm = -std::log(zeta);
    if (!(lambda > 0.0)) return {0.0, logarithm};
    double v = std::min(logarithm, std::log1p(lambda * logarithm));
    for (int i = 0; i < 100; ++i) {
        const double grown = std::expm1(v);
        const double step = (grown / lambda + v - logarithm) / ((grown + 1.0) / lambda + 1.0);
        v = std::max(0.0, v - step);
        if (!(step > std::numeric_limits<double>::epsilon() * v)) break;
    }
    return {std::expm1(v), logarithm - v};
}

}  // namespace

double ExponentialSoftening::dissipated(const Toughness& t, double zeta) const {
    if (!(zeta > 0.0)) return t.total;
    const double lambda = decay_length(t);
    const Place at = place_of(lambda, zeta);
    return t.onset * (-std::expm1(-at.decays) * (1.0 + 2.0 * lambda) - std::exp(-at.decays) * at.beyond);
}

double ExponentialSoftening::driving(const Toughness& t, double zeta) const {
    const double lambda = decay_length(t);
    if (!(lambda > 0.0)) return t.onset;
    if (!(zeta > 0.0)) return std::numeric_limits<double>::infinity();
    const double x = 1.0 + place_of(lambda, zeta).beyond;
    return t.onset * x * x;
}

// d zeta/dx = -zeta (1/lambda + 1/x), dY/dx = 2 Go x.
double ExponentialSoftening::driving_slope(const Toughness& t, double zeta) const {
    const double lambda = decay_length(t);
    if (!(lambda > 0.0)) return 0.0;
    if (!(zeta > 0.0)) return -std::numeric_limits<double>::infinity();
    const double x = 1.0 + place_of(lambda, zeta).beyond;
    return -2.0 * t.onset * (x * x * (lambda / (zeta * (lambda + x))));
}

// x - 1 = (Y/Go - 1)/(x + 1), whose difference is exact next to the onset.
double ExponentialSoftening::minimiser(const Toughness& t, double driving, double zeta_old) const {
    const double lambda = decay_length(t);
    if (!(lambda > 0.0)) return driving < t.total ? zeta_old : 0.0;
    if (driving <= t.onset) return zeta_old;
    const double x = std::sqrt(driving / t.onset);
    const double beyond = ((driving - t.onset) / t.onset) / (x + 1.0);
    return std::min(zeta_old, std::exp(-beyond / lambda) / x);
}

double ExponentialSoftening::slope(const Toughness& t, double driving, double zeta_old) const {
    const double zeta = minimiser(t, driving, zeta_old);
    if (!(zeta > 0.0 && zeta < zeta_old)) return 0.0;
    return -0.5 * zeta * (std::sqrt(driving / t.onset) / decay_length(t) + 1.0) / driving;
}

// g is the maximum over x of (energy under the curve up to x) - zeta Y. Its derivative at the same zeta is therefore
// that of the area at the same x: d/dGc of Go [1 + 2 lambda (1-s)].
double ExponentialSoftening::total_share(const Toughness& t, double zeta) const {
    if (!(zeta > 0.0)) return 1.0;
    const double decays = place_of(decay_length(t), zeta).decays;
    return -std::expm1(-decays) - decays * std::exp(-decays);
}

}  // namespace delam
