// SPDX-License-Identifier: BSD-3-Clause
// Every softening shape with every criterion, against brute-force minimisation, quadrature of the traction, and
// differences.
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "base/error.hpp"
#include "check.hpp"
#include "delam/delam.h"
#include "law/law.hpp"
#include "laws.hpp"

using delam::Law;
using delam::Toughness;

namespace {

bool close(double a, double b, double tolerance) {
    return std::abs(a - b) <= tolerance * std::max(std::abs(a), std::abs(b));
}

// body(name, law, toughness) over shapes, criteria, ratios and mixities. In the pure modes all criteria give the same
// toughness, which is expected here, so that one of them is enough for the body.
template <class Body>
void everywhere(Body&& body) {
    for (const double ratio : {1.02, 2.5, 40.0}) {
        const auto first = laws::shapes(laws::criteria[0], ratio);
        for (const delam::Criterion criterion : laws::criteria) {
            const auto shapes = laws::shapes(criterion, ratio);
            for (std::size_t i = 0; i < shapes.size(); ++i)
                for (const double b : {0.0, 0.3, 1.0}) {
                    const Toughness t = shapes[i].law.toughness(b), other = first[i].law.toughness(b);
                    const std::string name = shapes[i].name + ", B = " + std::to_string(b);
                    if (criterion == laws::criteria[0] || b == 0.3) {
                        body(name.c_str(), shapes[i].law, t);
                        continue;
                    }
                    ck_assert_msg(close(t.onset, other.onset, 1e-15) && close(t.total, other.total, 1e-15), "%s",
                                  name.c_str());
                }
        }
    }
}

// Y at which the fraction `share` of the adhesion's way down to 1e-3 is done, with room beyond either end.
double driving_at(const Law& law, const Toughness& t, double share) {
    const double first = 0.5 * t.onset, last = 1.5 * law.driving(t, 1e-3);
    return first * std::pow(last / first, share);
}

}  // namespace

TEST(minimiser_is_least) {
    constexpr int points = 1000;
    everywhere([&](const char* name, const Law& law, const Toughness& t) {
        std::vector<double> g;
        for (int j = 0; j <= points; ++j) g.push_back(law.dissipated(t, j / static_cast<double>(points)));
        for (const double old : {1.0, 0.4, 0.0}) {
            double before = old;
            for (int i = 0; i <= 40; ++i) {
                const double y = driving_at(law, t, i / 40.0);
                const double z = law.minimiser(t, y, old);
                ck_assert_msg(z >= 0.0 && z <= before, "%s: zeta %g after %g", name, z, before);
                before = z;
                double least = z * y + law.dissipated(t, z);
                const double rounding = 1e-13 * (t.total + y);
                for (int j = 0; j <= points * old; ++j) {
                    const double at = j / static_cast<double>(points);
                    ck_assert_msg(least <= at * y + g[static_cast<std::size_t>(j)] + rounding,
                                  "%s, Y = %g, old %g: %.17g at zeta = %g, but %.17g at %g", name, y, old, least, z,
                                  at * y + g[static_cast<std::size_t>(j)], at);
                }
                ck_assert_msg(least <= old * y + law.dissipated(t, old) + rounding, "%s: old adhesion", name);
            }
        }
    });
}

// g(1) = 0, g(0) = Gc, g convex and decreasing, Y = -g' and its slope by differences inside smooth parts.
TEST(energy) {
    everywhere([](const char* name, const Law& law, const Toughness& t) {
        ck_assert(std::abs(law.dissipated(t, 1.0)) <= 1e-15 * t.total);
        ck_assert_msg(close(law.dissipated(t, 0.0), t.total, 1e-15), "%s", name);
        ck_assert_msg(close(law.dissipated(t, 1e-9), t.total, 1e-5), "%s: g(0+) %g", name, law.dissipated(t, 1e-9));
        ck_assert_msg(close(law.driving(t, 1.0), t.onset, 1e-14), "%s", name);
        ck_assert(std::abs(law.stored_linear(t, 0.0)) <= 1e-15 * t.total);
        ck_assert(std::abs(law.stored_linear(t, 1.0)) <= 1e-15 * t.total);
        constexpr int n = 400;
        for (int i = 1; i < n; ++i) {
            const double low = (i - 1.0) / n, z = i / static_cast<double>(n), high = (i + 1.0) / n;
            const double y = law.driving(t, z);
            ck_assert_msg(y <= law.driving(t, low) * (1 + 1e-13), "%s", name);
            ck_assert_msg(y >= law.driving(t, high) * (1 - 1e-13), "%s", name);
            // Convex: the chord's slope lies between those of its ends.
            const double chord = (law.dissipated(t, low) - law.dissipated(t, z)) * n, slack = 1e-11 * t.total;
            ck_assert_msg(chord >= y - slack && chord <= law.driving(t, low) + slack, "%s, zeta %g: %g, %g", name, z,
                          chord, y);
            ck_assert(law.stored_linear(t, z) <= 1e-15 * t.total);
            const double other_split = law.dissipated(t, z) - t.total * (1.0 - z);
            ck_assert_msg(std::abs(law.stored_linear(t, z) - other_split) <= 1e-14 * t.total, "%s", name);
            const double h = 1e-5 * z;
            const double left = (y - law.driving(t, z - h)) / h, right = (law.driving(t, z + h) - y) / h;
            const double slope = law.driving_slope(t, z);
            ck_assert(slope <= 0.0);
            if (std::abs(left - right) <= 1e-3 * std::abs(left)) {
                const double middle = 0.5 * (left + right);
                ck_assert_msg(std::abs(slope - middle) <= 1e-6 * std::abs(slope) + 1e-9 * t.onset / z,
                              "%s, zeta %g: %.12g, %.12g", name, z, slope, middle);
            }
        }
    });
}

// Inside the bounds the minimiser inverts Y(zeta), with the reciprocal of its slope.
TEST(inverse) {
    everywhere([](const char* name, const Law& law, const Toughness& t) {
        for (int i = 1; i < 200; ++i) {
            const double z = i / 200.0, y = law.driving(t, z), slope = law.driving_slope(t, z);
            if (!(slope < 0.0)) continue;  // a drop: Y is the same for many zeta
            const double ahead = law.driving(t, z * (1 - 1e-6)), behind = law.driving(t, z * (1 + 1e-6));
            if (!(ahead > y && y > behind)) continue;
            // Rounding of Y, and of x - 1 where the softening branch is short.
            const double slack = 1e-14 + 4e-15 * y / std::abs(slope) + 1e-15 * t.onset / (t.total - t.onset);
            const double back = law.minimiser(t, y, 1.0);
            ck_assert_msg(std::abs(back - z) <= slack, "%s: zeta %.17g came back as %.17g", name, z, back);
            const double left = law.driving_slope(t, z * (1 - 1e-6)), right = law.driving_slope(t, z * (1 + 1e-6));
            if (!close(left, right, 1e-4)) continue;
            ck_assert_msg(close(law.slope(t, y, 1.0) * slope, 1.0, 1e-5), "%s, zeta %g: %g times %g", name, z,
                          law.slope(t, y, 1.0), slope);
        }
        ck_assert(law.slope(t, 0.5 * t.onset, 1.0) == 0.0);
        ck_assert(law.slope(t, t.onset * 1.0001, 1e-9) == 0.0);
    });
}

// First loading with stiffness k: peak sqrt(2 k Go) at the onset, area Gc. The midpoint rule with 100,000 steps has an
// error of 1e-9 where the curve is smooth, and of part of a step at a drop.
TEST(traction) {
    constexpr double k = 125e9;
    everywhere([&](const char* name, const Law& law, const Toughness& t) {
        const double onset_jump = std::sqrt(2.0 * t.onset / k), peak = std::sqrt(2.0 * k * t.onset);
        const double just_before = onset_jump * (1.0 - 1e-9);
        const double adhesion = law.minimiser(t, 0.5 * k * just_before * just_before, 1.0);
        ck_assert_msg(close(adhesion * k * just_before, peak, 1e-8), "%s", name);
        const bool endless = std::isinf(law.driving(t, 0.0));
        const double last = std::sqrt(2.0 * law.driving(t, endless ? 1e-15 : 0.0) / k) * 1.0001;
        constexpr int n = 100000;
        double area = 0.5 * peak * onset_jump, highest = 0.0;
        const double step = (last - onset_jump) / n;
        for (int i = 0; i < n; ++i) {
            const double u = onset_jump + (i + 0.5) * step;
            const double pull = law.minimiser(t, 0.5 * k * u * u, 1.0) * k * u;
            highest = std::max(highest, pull);
            area += pull * step;
        }
        ck_assert_msg(close(area, t.total, 3e-5), "%s: area %.9g, toughness %.9g", name, area, t.total);
        ck_assert_msg(highest <= peak * (1 + 1e-12), "%s", name);
    });
}

// Close to Griffith's law every shape breaks between Go and Gc^2/Go and dissipates Gc, without a rounding accident.
TEST(towards_griffith) {
    for (const delam::Criterion criterion : laws::criteria) {
        for (laws::Named& named : laws::shapes(criterion, 1.0)) {
            Law& law = named.law;
            for (int k = 4; k <= 52; ++k) {
                const double d = std::ldexp(1.0, -k);
                const Toughness t{1.0, 1.0 + d, 0.0};
                ck_assert(law.minimiser(t, 1.0 - 1e-15, 0.8) == 0.8);
                ck_assert_msg(law.minimiser(t, 1.0 + 40.0 * d, 0.8) <= 1e-6, "%s, D = 2^-%d: %g", named.name.c_str(), k,
                              law.minimiser(t, 1.0 + 40.0 * d, 0.8));
                for (const double z : {0.1, 0.5, 0.9}) {
                    ck_assert_msg(std::abs(law.dissipated(t, z) - (1.0 - z)) <= 2.0 * d, "%s", named.name.c_str());
                    const double y = law.driving(t, z);
                    ck_assert_msg(y >= 1.0 && y <= 1.0 + 20.0 * d, "%s, D = 2^-%d: Y(%g) = 1 + %g", named.name.c_str(),
                                  k, z, y - 1.0);
                }
            }
            const Toughness griffith{2.0, 2.0, 0.0};
            ck_assert(law.minimiser(griffith, std::nextafter(2.0, 0.0), 0.8) == 0.8);
            ck_assert(law.minimiser(griffith, 2.0, 0.8) == 0.0);
            ck_assert(close(law.dissipated(griffith, 0.25), 1.5, 1e-15));
            ck_assert(law.driving(griffith, 0.25) == 2.0);
            ck_assert(law.driving_slope(griffith, 0.25) == 0.0);
        }
    }
}

// The trapezium without plateau and the table of two points are the bilinear law.
TEST(same_law) {
    const auto all = laws::shapes(delam::Criterion::power, 7.0);
    const Law& bilinear = all[0].law;
    Law two = all[5].law;
    const double xi[] = {0.0, 1.0}, s[] = {1.0, 0.0};
    std::get<delam::TabulatedSoftening>(two.softening).set_table(xi, s);
    for (const Law& other : {all[2].law, two})
        for (const double b : {0.0, 0.4, 1.0}) {
            const Toughness t = bilinear.toughness(b);
            for (int i = 0; i <= 100; ++i) {
                const double z = i / 100.0, y = bilinear.driving(t, z);
                ck_assert(close(other.dissipated(t, z), bilinear.dissipated(t, z), 1e-13));
                ck_assert(close(other.driving(t, z), y, 1e-14));
                ck_assert(close(other.driving_slope(t, z), bilinear.driving_slope(t, z), 1e-13));
                const double least = bilinear.minimiser(t, y * 1.001, 1.0);
                ck_assert(std::abs(other.minimiser(t, y * 1.001, 1.0) - least) <= 1e-13);
                ck_assert(close(other.dissipated_slope_mixity(b, z), bilinear.dissipated_slope_mixity(b, z), 1e-12));
            }
        }
}

// dg/dB at the same zeta, by differences.
TEST(mixity_slopes) {
    for (const delam::Criterion criterion : laws::criteria)
        for (const double ratio : {1.02, 2.5, 40.0})
            for (const laws::Named& named : laws::shapes(criterion, ratio))
                for (const double b : {0.05, 0.5, 0.93})
                    for (int i = 0; i <= 20; ++i) {
                        const double z = i / 20.0, h = 1e-5;
                        const double g = named.law.dissipated(named.law.toughness(b + h), z) -
                                         named.law.dissipated(named.law.toughness(b - h), z);
                        const double slope = named.law.dissipated_slope_mixity(b, z);
                        ck_assert_msg(std::abs(slope - g / (2.0 * h)) <= 1e-6 * named.law.toughness(b).total,
                                      "%s, B %g, zeta %g: %.12g, %.12g", named.name.c_str(), b, z, slope,
                                      g / (2.0 * h));
                    }
}

// Powers of two scale doubles exactly: any dependence on units other than by a factor would show in the last bit.
TEST(units) {
    for (const laws::Named& named : laws::shapes(delam::Criterion::benzeggagh_kenane, 3.7)) {
        const Law& law = named.law;
        for (const int power : {-60, -1, 30}) {
            const double unit = std::ldexp(1.0, power);
            Law other = law;
            for (double Law::*g :
                 {&Law::normal_onset, &Law::tangential_onset, &Law::normal_toughness, &Law::tangential_toughness})
                other.*g *= unit;
            for (const double b : {0.0, 0.37, 1.0}) {
                const Toughness t = law.toughness(b), o = other.toughness(b);
                ck_assert(o.onset == t.onset * unit && o.total == t.total * unit);
                ck_assert(other.toughness_slope(b).onset == law.toughness_slope(b).onset * unit);
                ck_assert(other.toughness_slope(b).total == law.toughness_slope(b).total * unit);
                for (const double z : {0.0, 0.1, 0.45, 0.8, 1.0}) {
                    ck_assert(other.dissipated(o, z) == law.dissipated(t, z) * unit);
                    ck_assert(other.driving(o, z) == law.driving(t, z) * unit);
                    ck_assert(other.driving_slope(o, z) == law.driving_slope(t, z) * unit);
                    ck_assert(other.stored_linear(o, z) == law.stored_linear(t, z) * unit);
                    ck_assert(other.dissipated_slope_mixity(b, z) == law.dissipated_slope_mixity(b, z) * unit);
                }
                for (const double y : {50.0, 150.0, 300.0, 1000.0, 5000.0}) {
                    ck_assert(other.minimiser(o, y * unit, 1.0) == law.minimiser(t, y, 1.0));
                    ck_assert(other.slope(o, y * unit, 1.0) == law.slope(t, y, 1.0) / unit);
                }
            }
        }
    }
}

// Copies are independent, also of tables.
TEST(values) {
    const Law first = laws::shapes(delam::Criterion::power, 3.0)[5].law;
    Law second = first;
    const double xi[] = {0.0, 1.0}, s[] = {1.0, 0.0};
    std::get<delam::TabulatedSoftening>(second.softening).set_table(xi, s);
    const Toughness t = first.toughness(0.0);
    ck_assert(first.dissipated(t, 0.5) != second.dissipated(t, 0.5));
    ck_assert(std::get<delam::TabulatedSoftening>(first.softening).corners().size() == 5);
}

// Jumps whose energy is near or beyond the largest double.
TEST(huge_jumps_break) {
    for (const laws::Named& named : laws::shapes(laws::criteria[0], 2.5))
        for (const double driving :
             {1e300, std::numeric_limits<double>::max(), std::numeric_limits<double>::infinity()})
            for (const double zeta_old : {1.0, 0.4, 0.0}) {
                const double zeta = named.law.minimiser(named.law.toughness(0.3), driving, zeta_old);
                ck_assert_msg(zeta >= 0.0 && zeta <= 1e-140, "%s: %g at %g", named.name.c_str(), zeta, driving);
            }
}
