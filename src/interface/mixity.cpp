// SPDX-License-Identifier: BSD-3-Clause
#include "interface/mixity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace delam {

double mode_mixity(double normal, double tangential) {
    if (!(tangential > 0.0)) return 0.0;
    return std::min(1.0, tangential / (normal + tangential));
}

namespace {

// With g = G/a = exp(-t), a <= c the toughnesses that each mode alone would allow, the criterion reads
//
//     phi(t) = exp(-p t) + rho exp(-q t) - 1 = 0,   rho = (a/c)^q in [0,1],   t >= 0.
//
// phi is convex and decreasing, so Newton's method started left of the root climbs to it and never passes it. Both
// terms share the larger exponent's bound, (1+rho) exp(-max(p,q) t) <= 1 at the root, which gives the start; each of
// them being at most 1/2 gives the right end of the bracket. Only ratios enter: the result does not know the units.
double decay(double rho, double p, double q) {
    if (!(rho > 0.0)) return 0.0;
    double left = std::log1p(rho) / std::max(p, q);
    double right = std::max({left, std::log(2.0) / p, std::log(2.0 * rho) / q});
    double t = left;
    for (int i = 0; i < 200; ++i) {
        const double second = rho * std::exp(-q * t);
        const double first = std::expm1(-p * t);
        const double phi = first + second;
        const double slope = p * (first + 1.0) + q * second;
        if (phi >= 0.0) left = t;
        else right = t;
        double next = t + phi / slope;
        if (!(next >= left && next <= right)) next = left + (right - left) / 2.0;
        if (std::abs(next - t) <= std::numeric_limits<double>::epsilon() * t) return next;
        t = next;
    }
    return t;
}

}  // namespace

double interaction(double normal_toughness, double tangential_toughness, double p, double q, double mixity) {
    // Whatever the mixity, to the last digit.
    if (normal_toughness == tangential_toughness && p == 1.0 && q == 1.0) return normal_toughness;
    // The total G at which one mode alone would reach its toughness; infinite for a mode that takes no part.
    double a = normal_toughness / (1.0 - mixity);
    double c = tangential_toughness / mixity;
    if (a > c) {
        std::swap(a, c);
        std::swap(p, q);
    }
    const double ratio = a / c;
    if (p == q) return a * std::exp(-std::log1p(std::pow(ratio, p)) / p);
    return a * std::exp(-decay(std::pow(ratio, q), p, q));
}

}  // namespace delam
