// SPDX-License-Identifier: BSD-3-Clause
#include "law/criterion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace delam {

namespace {

// With g = G/a = exp(-t), and a <= c the toughnesses that each mode alone would allow, the criterion reads
//
//     phi(t) = exp(-p t) + rho exp(-q t) - 1 = 0,   rho = (a/c)^q in [0,1],   t >= 0.
//
// phi is convex and decreasing, so Newton's method started left of the root increases towards it and never passes it.
// Both terms share the larger exponent's bound, (1+rho) exp(-max(p,q) t) <= 1 at the root, which gives the start; each
// of them is at most 1/2 at the right end of the bracket. Only ratios enter, so the result does not depend on the
// units.
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
        if (phi >= 0.0)
            left = t;
        else
            right = t;
        double next = t + phi / slope;
        if (!(next >= left && next <= right)) next = left + (right - left) / 2.0;
        if (std::abs(next - t) <= std::numeric_limits<double>::epsilon() * t) return next;
        t = next;
    }
    return t;
}

}  // namespace

double interaction(double normal_toughness, double tangential_toughness, double p, double q, double mixity) {
    // The same for every mixity, to the last digit.
    if (normal_toughness == tangential_toughness && p == 1.0 && q == 1.0) return normal_toughness;
    // The total G at which one mode alone would reach its toughness; infinite if the mode is absent.
    double a = normal_toughness / (1.0 - mixity);
    double c = tangential_toughness / mixity;
    if (a > c) {
        std::swap(a, c);
        std::swap(p, q);
    }
    const double ratio = a / c;
    // The factors below round to 1, as in symmetric scenes, whose second mode is rounding.
    if (ratio < 0x1p-55 && p >= 1.0 && q >= 1.0) return a;
    if (p == q) return a * std::exp(-std::log1p(std::pow(ratio, p)) / p);
    return a * std::exp(-decay(std::pow(ratio, q), p, q));
}

namespace {

constexpr double nearest = 1e-6;  // distance from a pure mode at which slopes that may be infinite are evaluated

constexpr std::pair<const char*, Criterion> names[] = {{"valoroso-champaney", Criterion::valoroso_champaney},
                                                       {"power", Criterion::power},
                                                       {"benzeggagh-kenane", Criterion::benzeggagh_kenane}};

// Along the criterion, with S = ((1-B) G/G_n)^p and T = (B G/G_t)^q = 1 - S,
//
//     dG/dB = G [p S/(1-B) - q T/B] / (p S + q T).
double interaction_slope(double gn, double gt, double p, double q, double mixity) {
    const double b = std::clamp(mixity, q < 1.0 ? nearest : 0.0, p < 1.0 ? 1.0 - nearest : 1.0);
    const double g = interaction(gn, gt, p, q, b);
    const double s = (1.0 - b) * (g / gn), t = b * (g / gt);
    const double first = p * std::pow(s, p - 1.0), second = q * std::pow(t, q - 1.0);
    return g * (first * (g / gn) - second * (g / gt)) / (first * s + second * t);
}

}  // namespace

bool criterion_of(const std::string& name, Criterion& criterion) {
    for (const auto& [known, value] : names)
        if (name == known) {
            criterion = value;
            return true;
        }
    return false;
}

const char* name_of(Criterion criterion) {
    for (const auto& [name, value] : names)
        if (value == criterion) return name;
    return "";
}

Modes along(Criterion criterion, const Modes& m, double second_share) {
    if (!m.two_shears()) return m;
    const Modes shears{m.tangential, m.second_shear, 1.0, 1.0};
    return {m.normal, toughness_at(criterion, shears, second_share), m.first, m.second};
}

double toughness_at(Criterion criterion, const Modes& m, const Mixity& mixity) {
    if (m.two_shears()) return toughness_at(criterion, along(criterion, m, mixity.second), mixity.shear);
    if (criterion == Criterion::benzeggagh_kenane)
        return m.normal + (m.tangential - m.normal) * std::pow(mixity.shear, m.first);
    return interaction(m.normal, m.tangential, m.first, m.second, mixity.shear);
}

double least_toughness(Criterion criterion, const Modes& m) {
    const double r = criterion == Criterion::benzeggagh_kenane ? 1.0 : std::min({m.first, m.second, 1.0});
    const double sliding = m.two_shears() ? std::min(m.tangential, m.second_shear) : m.tangential;
    return std::exp2(1.0 - 1.0 / r) * std::min(m.normal, sliding);
}

double toughness_slope_at(Criterion criterion, const Modes& m, double mixity) {
    if (!depends_on_mixity(criterion, m)) return 0.0;
    if (criterion == Criterion::benzeggagh_kenane) {
        const double b = m.first < 1.0 ? std::max(mixity, nearest) : mixity;
        return (m.tangential - m.normal) * m.first * std::pow(b, m.first - 1.0);
    }
    return interaction_slope(m.normal, m.tangential, m.first, m.second, mixity);
}

bool depends_on_mixity(Criterion criterion, const Modes& m) {
    if (m.normal != m.tangential || m.two_shears()) return true;
    return criterion != Criterion::benzeggagh_kenane && (m.first != 1.0 || m.second != 1.0);
}

}  // namespace delam
