// SPDX-License-Identifier: BSD-3-Clause
// The interface law against closed forms of the bilinear traction-separation law, brute-force minimisation, and changes
// of units.
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "check.hpp"
#include "delam/delam.h"
#include "law/admissible.hpp"
#include "law/criterion.hpp"
#include "law/law.hpp"
#include "law/law_parameters.hpp"
#include "law/mixity.hpp"
#include "refused.hpp"

using delam::Law;
using delam::Toughness;

namespace {

void no_gsl_handler() { gsl_set_error_handler_off(); }
BEFORE_TESTS(no_gsl_handler);

bool close(double a, double b, double tolerance) {
    return std::abs(a - b) <= tolerance * std::max(std::abs(a), std::abs(b));
}

Law bilinear(double stiffness, double onset, double toughness) {
    Law law;
    law.normal_stiffness = law.tangential_stiffness = stiffness;
    law.normal_onset = law.tangential_onset = onset;
    law.normal_toughness = law.tangential_toughness = toughness;
    return law;
}
const delam::LinearSoftening shape;
const Law ductile = bilinear(125e9, 100.0, 250.0);
const Law brittle = bilinear(125e15, 0.01, 25.0);

// ((1-B) G/G_n)^p + (B G/G_t)^q - 1 in long double.
long double residual(long double g, double gn, double gt, double p, double q, double b) {
    const long double first = (1.0L - static_cast<long double>(b)) * g / static_cast<long double>(gn);
    const long double second = static_cast<long double>(b) * g / static_cast<long double>(gt);
    return std::pow(first, static_cast<long double>(p)) + std::pow(second, static_cast<long double>(q)) - 1.0L;
}

// The same root by bisection in long double, over the logarithm of G.
double reference_interaction(double gn, double gt, double p, double q, double b) {
    long double low = std::log(std::min<long double>(gn, gt)) - 100.0L;
    long double high = std::log(std::min(static_cast<long double>(gn) / (1.0L - static_cast<long double>(b)),
                                         static_cast<long double>(gt) / static_cast<long double>(b)));
    for (int i = 0; i < 200; ++i) {
        const long double middle = low + (high - low) / 2.0L;
        (residual(std::exp(middle), gn, gt, p, q, b) > 0.0L ? high : low) = middle;
    }
    return static_cast<double>(std::exp(low));
}

// Message of a refused law; empty if it is accepted.
std::string refusal(const Law& law) {
    return unit::refusal(DELAM_ERROR_PROBLEM, [&] { validate(law); });
}

}  // namespace

TEST(bilinear_law) {
    const struct {
        Law law;
        double sigma0, d0, dc;
    } cases[] = {{ductile, 5e6, 4e-5, 1e-4}, {brittle, 50e6, 4e-10, 1e-6}};
    for (const auto& c : cases) {
        for (const double mixity : {0.0, 1.0}) {
            const Toughness t = c.law.toughness(mixity);
            const double k = c.law.normal_stiffness;
            ck_assert(close(std::sqrt(2.0 * k * t.onset), c.sigma0, 1e-12));
            ck_assert(close(std::sqrt(2.0 * t.onset / k), c.d0, 1e-12));
            ck_assert(close(c.d0 * t.total / t.onset, c.dc, 1e-12));
            // On the softening branch zeta k u = sigma0 (dc - u)/(dc - d0).
            for (int i = 0; i <= 1000; ++i) {
                const double u = c.dc * 1.2 * i / 1000.0;
                const double zeta = shape.minimiser(t, 0.5 * k * u * u, 1.0);
                double expected = u <= c.d0 ? k * u : c.sigma0 * (c.dc - u) / (c.dc - c.d0);
                if (u >= c.dc) expected = 0.0;
                ck_assert(std::abs(zeta * k * u - expected) <= 2e-12 * c.sigma0);
            }
            // Work of separation, exact on a piecewise-linear law by the trapezoidal rule between its corners.
            double area = 0.0;
            double last = 0.0;
            double at_last = 0.0;
            for (const double u : {c.d0, c.dc}) {
                const double traction = shape.minimiser(t, 0.5 * k * u * u, 1.0) * k * u;
                area += 0.5 * (u - at_last) * (traction + last);
                last = traction;
                at_last = u;
            }
            ck_assert(close(area, t.total, 1e-12));
            ck_assert(close(shape.dissipated(t, 0.0), t.total, 1e-15));
        }
    }
}

TEST(minimiser_against_scan) {
    constexpr int n = 20000;
    for (const double ratio : {1.0 + 1e-3, 1.5, 2.5, 100.0, 2500.0}) {
        const Toughness t{3.0, 3.0 * ratio};
        for (const double zeta_old : {1.0, 0.7, 0.05, 0.0}) {
            for (int i = 0; i < 60; ++i) {
                const double y = 3.0 * std::pow(ratio, 2.4 * i / 59.0 - 0.2);
                const auto linear_split = [&](double z) {
                    return z * y + shape.stored_linear(t, z) + t.total * (zeta_old - z);
                };
                const auto ledger = [&](double z) {
                    return z * y + shape.dissipated(t, z) - shape.dissipated(t, zeta_old);
                };
                double best = 0.0;
                double best_ledger = 0.0;
                for (int j = 0; j <= n; ++j) {
                    const double z = zeta_old * j / n;
                    if (linear_split(z) < linear_split(best)) best = z;
                    if (ledger(z) < ledger(best_ledger)) best_ledger = z;
                }
                const double z = shape.minimiser(t, y, zeta_old);
                ck_assert(z >= 0.0 && z <= zeta_old);
                const double rounding = 1e-13 * (t.total + y);
                ck_assert(linear_split(z) <= linear_split(best) + rounding);
                ck_assert(ledger(z) <= ledger(best_ledger) + rounding);
                // For a law close to Griffith's, the energy between its ends is flat to rounding, so the position of
                // its minimum means nothing there.
                if (ratio >= 1.5) ck_assert(std::abs(z - best) <= zeta_old / n + 1e-9);
            }
        }
    }
}

// The two splits: f + Gc (1 - zeta) = g. Where the minimiser is inside, Y = -g'(zeta); both by differences of g.
TEST(derivatives) {
    const Toughness t{1.0, 7.0};
    for (int i = 1; i < 20; ++i) {
        const double z = i / 20.0;
        ck_assert(close(shape.stored_linear(t, z) + t.total * (1.0 - z), shape.dissipated(t, z), 1e-14));
        ck_assert(shape.stored_linear(t, z) <= 0.0);
        const double h = 1e-5;
        const double slope = (shape.dissipated(t, z + h) - shape.dissipated(t, z - h)) / (2.0 * h);
        const double curvature = shape.dissipated(t, z + h) - 2.0 * shape.dissipated(t, z) + shape.dissipated(t, z - h);
        ck_assert(curvature > 0.0);
        ck_assert(std::abs(shape.minimiser(t, -slope, 1.0) - z) < 1e-8);
    }
    ck_assert(shape.dissipated(t, 1.0) == 0.0);
    ck_assert(shape.stored_linear(t, 0.0) == 0.0);
    ck_assert(shape.stored_linear(t, 1.0) == 0.0);
}

TEST(griffith_limit) {
    const Toughness griffith{2.0, 2.0};
    ck_assert(shape.minimiser(griffith, std::nextafter(2.0, 0.0), 0.8) == 0.8);
    ck_assert(shape.minimiser(griffith, 2.0, 0.8) == 0.0);
    ck_assert(shape.minimiser(griffith, 0.0, 0.8) == 0.8);
    ck_assert(close(shape.dissipated(griffith, 0.25), 1.5, 1e-15));
    ck_assert(shape.stored_linear(griffith, 0.5) == 0.0);
    // D/Go = 2^-k down to one unit in the last place: with Y = Go (1 + 2 s D/Go) the minimiser is 1 - s up to O(D/Go)
    // and the rounding of Y itself.
    for (int k = 4; k <= 50; ++k) {
        const double d = std::ldexp(1.0, -k);
        const Toughness t{1.0, 1.0 + d};
        for (const double s : {0.25, 0.5, 0.75}) {
            const double y = 1.0 + 2.0 * s * d;
            // ((1 + D)/r - 1)/D with r^2 = y = 1 + 2 s D, without its cancellation
            const double r = std::sqrt(y), exact = (2.0 + d - 2.0 * s) / (r * (1.0 + d + r));
            const double z = shape.minimiser(t, y, 1.0);
            ck_assert_msg(std::abs(z - exact) < 1e-14, "D = 2^-%d, s = %g: %.17g, not %.17g", k, s, z, exact);
            ck_assert(std::abs(z - (1.0 - s)) <= 2.0 * d);
        }
    }
    ck_assert(shape.minimiser({1.0, 2.0}, 0.0, 0.3) == 0.3);
    ck_assert(shape.minimiser({1.0, 2.0}, std::numeric_limits<double>::max(), 0.3) == 0.0);
    ck_assert(shape.minimiser({1.0, 2.0}, 4.0, 1.0) == 0.0);
}

TEST(interaction_closed_form) {
    for (const double a : {0.05, 0.5, 1.0, 2.0, 7.0, 50.0}) {
        for (const double ratio : {1.0, 4.0, 1e-5, 1e10}) {
            for (int i = 0; i <= 40; ++i) {
                const double b = i / 40.0;
                const double g = delam::interaction(3.0, 3.0 * ratio, a, a, b);
                if (i == 0)
                    ck_assert(g == 3.0);
                else if (i == 40)
                    ck_assert(g == 3.0 * ratio);
                else
                    ck_assert(close(g, reference_interaction(3.0, 3.0 * ratio, a, a, b), 1e-13));
            }
        }
    }
    ck_assert(close(delam::interaction(5.0, 5.0, 2.0, 2.0, 0.5), 5.0 * std::sqrt(2.0), 1e-15));
    for (int i = 0; i <= 10; ++i) ck_assert(close(delam::interaction(5.0, 5.0, 1.0, 1.0, i / 10.0), 5.0, 1e-15));
}

TEST(interaction_unequal_exponents) {
    const std::array<double, 7> exponents{0.05, 0.3, 1.0, 2.0, 3.7, 20.0, 50.0};
    for (const double p : exponents) {
        for (const double q : exponents) {
            if (p == q) continue;
            for (const double ratio : {1.0, 0.03, 1e10, 1e-10}) {
                for (const double b : {1e-300, 1e-12, 1e-3, 0.1, 0.5, 0.77, 0.999, 1.0 - 1e-13}) {
                    const double g = delam::interaction(2.0, 2.0 * ratio, p, q, b);
                    const double exact = reference_interaction(2.0, 2.0 * ratio, p, q, b);
                    ck_assert_msg(close(g, exact, 3e-14), "p %g q %g ratio %g B %g: %.17g, not %.17g", p, q, ratio, b,
                                  g, exact);
                }
            }
        }
    }
    ck_assert(delam::interaction(2.0, 5.0, 1.5, 3.0, 0.0) == 2.0);
    ck_assert(delam::interaction(2.0, 5.0, 1.5, 3.0, 1.0) == 5.0);
    // Nearly equal exponents lead to the closed form.
    const double equal = delam::interaction(2.0, 5.0, 2.0, 2.0, 0.4);
    ck_assert(close(delam::interaction(2.0, 5.0, 2.0, std::nextafter(2.0, 3.0), 0.4), equal, 1e-14));
}

TEST(mixity) {
    ck_assert(delam::mode_mixity(0.0, 0.0) == 0.0);
    ck_assert(delam::mode_mixity(3.0, 0.0) == 0.0);
    ck_assert(delam::mode_mixity(0.0, 1e-300) == 1.0);
    ck_assert(delam::mode_mixity(3.0, 1.0) == 0.25);
    // psi = sqrt(k_t/k_n) u_t/u_n, B = psi^2/(1 + psi^2)
    const double psi = std::sqrt(2.0 / 5.0) * 0.3 / 0.7;
    ck_assert(close(delam::mode_mixity(0.5 * 5.0 * 0.49, 0.5 * 2.0 * 0.09), psi * psi / (1.0 + psi * psi), 1e-15));
}

// Powers of two scale doubles exactly: any dependence on units other than by a factor would show in the last bit.
TEST(units) {
    Law law = ductile;
    law.tangential_onset = 170.0;
    law.tangential_toughness = 600.0;
    for (const double second : {2.0, 1.3}) {
        law.onset_exponent_2 = law.toughness_exponent_2 = second;
        for (const int power : {-60, -20, -1, 1, 30, 60}) {
            const double unit = std::ldexp(1.0, power);
            Law other = law;
            for (double Law::*g :
                 {&Law::normal_onset, &Law::tangential_onset, &Law::normal_toughness, &Law::tangential_toughness})
                other.*g *= unit;
            for (int i = 0; i <= 16; ++i) {
                const Toughness t = law.toughness(i / 16.0);
                const Toughness o = other.toughness(i / 16.0);
                ck_assert(o.onset == t.onset * unit);
                ck_assert(o.total == t.total * unit);
                for (const double y : {50.0, 150.0, 222.0, 300.0, 450.0, 1000.0}) {
                    const double z = shape.minimiser(t, y, 1.0);
                    ck_assert(shape.minimiser(o, y * unit, 1.0) == z);
                    ck_assert(shape.dissipated(o, z) == shape.dissipated(t, z) * unit);
                    ck_assert(shape.stored_linear(o, z) == shape.stored_linear(t, z) * unit);
                }
            }
        }
    }
}

TEST(parameters) {
    Law law;
    for (const char* key : {"normal_stiffness", "tangential_stiffness", "normal_onset", "tangential_onset",
                            "normal_toughness", "tangential_toughness"}) {
        ck_assert_msg(refusal(law).find(key) != std::string::npos, "%s", refusal(law).c_str());
        ck_assert(set_parameter(law, key, 2.0));
    }
    ck_assert(refusal(law).empty());
    ck_assert(!set_parameter(law, "stiffness", 1.0));
    for (const char* key : {"onset_exponent_1", "onset_exponent_2", "toughness_exponent_1", "toughness_exponent_2"}) {
        for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
            Law broken = law;
            ck_assert(set_parameter(broken, key, bad));
            ck_assert(refusal(broken).find(key) != std::string::npos);
        }
    }
    ck_assert(set_parameter(law, "normal_toughness", 1.9));
    ck_assert(refusal(law).find("normal_toughness 1.9 < normal_onset 2") != std::string::npos);
    ck_assert(set_parameter(law, "normal_toughness", 2.0 * (1.0 - 1e-14)));  // rounding
    ck_assert(refusal(law).empty());
    ck_assert(law.toughness(0.0).total >= law.toughness(0.0).onset);
}

TEST(toughness_below_onset_between_the_modes) {
    // Exponent 8 at onset leaves 2^(7/8) G at B = 1/2, exponent 1 of the toughness only 1.2 G.
    Law law = bilinear(1e9, 100.0, 120.0);
    law.onset_exponent_1 = law.onset_exponent_2 = 8.0;
    law.toughness_exponent_1 = law.toughness_exponent_2 = 1.0;
    const std::string text = refusal(law);
    ck_assert_msg(text.find("B = 0.5") != std::string::npos, "%s", text.c_str());
    law.normal_toughness = law.tangential_toughness = 100.0 * std::pow(2.0, 7.0 / 8.0) * (1.0 + 1e-9);
    ck_assert(refusal(law).empty());
    law.normal_toughness = law.tangential_toughness = 100.0 * std::pow(2.0, 7.0 / 8.0) * (1.0 - 1e-9);
    ck_assert(!refusal(law).empty());
    // The minimum lies where the weaker mode takes over: far from the middle if the toughnesses are far apart.
    for (const double apart : {1e-9, 1e-4, 1e4, 1e9}) {
        Law far = bilinear(1e9, 100.0, 120.0);
        far.tangential_onset *= apart;
        far.tangential_toughness *= apart;
        far.onset_exponent_1 = far.onset_exponent_2 = 50.0;
        far.toughness_exponent_1 = far.toughness_exponent_2 = 2.0;
        ck_assert(!refusal(far).empty());
        far.onset_exponent_1 = far.onset_exponent_2 = 2.0;
        far.toughness_exponent_1 = far.toughness_exponent_2 = 50.0;
        ck_assert(refusal(far).empty());
    }
    // Equal exponents can never fail, whatever their value.
    Law fine = bilinear(1e9, 100.0, 100.0);
    fine.tangential_onset = 3.0;
    fine.tangential_toughness = 1e6;
    fine.onset_exponent_1 = fine.toughness_exponent_1 = 0.4;
    fine.onset_exponent_2 = fine.toughness_exponent_2 = 9.0;
    ck_assert(refusal(fine).empty());
}

// The area under the traction-jump curve is the total toughness, at any fixed mixity, by GSL's adaptive quadrature.
TEST(area_is_the_toughness) {
    struct Path {
        Toughness t;
        double stiffness;
    };
    const auto traction = [](double jump, void* data) {
        const Path& path = *static_cast<const Path*>(data);
        const double driving = 0.5 * path.stiffness * jump * jump;
        return shape.minimiser(path.t, driving, 1.0) * path.stiffness * jump;
    };
    gsl_integration_workspace* work = gsl_integration_workspace_alloc(1000);
    for (const Law& law : {ductile, brittle}) {
        for (const double b : {0.0, 0.25, 0.5, 1.0}) {
            Path path{law.toughness(b), law.normal_stiffness};
            const double first = std::sqrt(2.0 * path.t.onset / path.stiffness);
            double corners[] = {0.0, first, first * path.t.total / path.t.onset};
            gsl_function curve{traction, &path};
            double area = 0.0, error = 0.0;
            const int status = gsl_integration_qagp(&curve, corners, 3, 0.0, 1e-10, 1000, work, &area, &error);
            ck_assert_int_eq(status, GSL_SUCCESS);
            ck_assert(close(area, path.t.total, 1e-10));
        }
    }
    gsl_integration_workspace_free(work);
}
