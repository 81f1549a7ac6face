// SPDX-License-Identifier: BSD-3-Clause
// A host law: the bilinear law written as callbacks is the bilinear law; callbacks that fail, or that do not derive
// from one energy, are refused by name.
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "base/error.hpp"
#include "check.hpp"
#include "delam/delam.h"
#include "law/admissible.hpp"
#include "law/law.hpp"
#include "law/law_parameters.hpp"
#include "laws.hpp"
#include "refused.hpp"

using delam::Law;
using delam::Toughness;

namespace {

bool close(double a, double b, double tolerance) {
    return std::abs(a - b) <= tolerance * std::max(std::abs(a), std::abs(b));
}

Law given(delam_adhesion_callback adhesion, delam_dissipation_callback dissipation, void* user) {
    Law law;
    law.normal_stiffness = 125e9;
    law.tangential_stiffness = 60e9;
    law.softening = delam::HostSoftening{"mine", adhesion, dissipation, user};
    return law;
}

template <class Body>
std::string refusal(Body&& body) {
    return unit::refusal(DELAM_ERROR_PROBLEM, body);
}

void expect(const std::string& text, const std::string& part) {
    ck_assert_msg(text.find("law 'mine': ") == 0 && text.find(part) != std::string::npos, "'%s' lacks '%s'",
                  text.c_str(), part.c_str());
}

// The answer of a callback, corrupted in one place.
enum Fault {
    none,
    zeta_high,
    zeta_low,
    zeta_slope,
    zeta_grows,
    zeta_outside,
    g_offset,
    g_slope,
    g_concave,
    g_mixity,
    g_nan,
    g_negative
};
struct Spoilt {
    laws::Bilinear data;
    Fault fault = none;
};

std::int32_t spoilt_adhesion(double mixity, double driving, double* zeta, double* slope, void* user) {
    auto& spoilt = *static_cast<Spoilt*>(user);
    const std::int32_t status = laws::adhesion(mixity, driving, zeta, slope, &spoilt.data);
    if (spoilt.fault == zeta_high && *zeta < 1.0) *zeta = 0.99 * *zeta + 0.01;
    if (spoilt.fault == zeta_low && driving > laws::at(spoilt.data, mixity).onset) *zeta *= 0.99;
    if (spoilt.fault == zeta_slope) *slope *= 1.05;
    if (spoilt.fault == zeta_grows && driving > 300.0 && driving < 500.0) *zeta = 1.0;
    if (spoilt.fault == zeta_outside && driving > 300.0) *zeta = -0.1;
    return status;
}

std::int32_t spoilt_dissipation(double mixity, double zeta, double* g, double* slope, double* mixity_slope,
                                void* user) {
    auto& spoilt = *static_cast<Spoilt*>(user);
    const std::int32_t status = laws::dissipation(mixity, zeta, g, slope, mixity_slope, &spoilt.data);
    if (spoilt.fault == g_offset) *g += 1.0;
    if (spoilt.fault == g_slope) *slope *= 1.01;
    if (spoilt.fault == g_concave) {
        *g = 250.0 * (1.0 - zeta * zeta);
        *slope = -500.0 * zeta;
    }
    if (spoilt.fault == g_mixity) *mixity_slope += 30.0;
    if (spoilt.fault == g_negative) *g = -1.0;
    if (spoilt.fault == g_nan && zeta < 0.3) *g = std::numeric_limits<double>::quiet_NaN();
    return status;
}

// An exponential curve: its driving energy at zeta = 0 is infinite. Go = 1, Gc = 4 at every mixity.
std::int32_t exponential_adhesion(double, double driving, double* zeta, double* slope, void* user) {
    const Law& law = *static_cast<const Law*>(user);
    *zeta = law.minimiser({1.0, 4.0}, driving, 1.0);
    *slope = law.slope({1.0, 4.0}, driving, 1.0);
    return 0;
}
std::int32_t exponential_dissipation(double, double zeta, double* g, double* slope, double* mixity_slope, void* user) {
    const Law& law = *static_cast<const Law*>(user);
    *g = law.dissipated({1.0, 4.0}, zeta);
    *slope = -law.driving({1.0, 4.0}, zeta);
    *mixity_slope = 0.0;
    return 0;
}

}  // namespace

TEST(same_as_the_bilinear_law) {
    laws::Bilinear data;
    const Law host = given(laws::adhesion, laws::dissipation, &data);
    Law own = laws::law("piecewise-linear", delam::Criterion::benzeggagh_kenane, 2.0);
    own.normal_onset = data.normal_onset;
    own.tangential_onset = data.tangential_onset;
    own.normal_toughness = data.normal_toughness;
    own.tangential_toughness = data.tangential_toughness;
    set_parameter(own, "onset_exponent", data.eta);
    set_parameter(own, "toughness_exponent", data.eta);
    validate(host);
    validate(own);
    ck_assert(host.depends_on_mixity());
    ck_assert(close(host.least_onset(), own.least_onset(), 1e-14));
    for (int i = 0; i <= 10; ++i) {
        const double b = i / 10.0;
        const Toughness h = host.toughness(b), o = own.toughness(b);
        ck_assert(close(h.onset, o.onset, 1e-14) && close(h.total, o.total, 1e-14) && h.mixity == b);
        if (i > 0 && i < 10) ck_assert(close(host.toughness_slope(b).onset, own.toughness_slope(b).onset, 1e-8));
        ck_assert(std::abs(host.toughness_slope(b).total - own.toughness_slope(b).total) <= 1e-12 * o.total);
        for (int k = 0; k <= 50; ++k) {
            const double z = k / 50.0, y = own.driving(o, z);
            ck_assert(std::abs(host.dissipated(h, z) - own.dissipated(o, z)) <= 1e-14 * o.total);
            ck_assert(std::abs(host.stored_linear(h, z) - own.stored_linear(o, z)) <= 1e-13 * o.total);
            ck_assert(close(host.driving(h, z), y, 1e-14));
            ck_assert_msg(close(host.driving_slope(h, z), own.driving_slope(o, z), 2e-5), "zeta %g: %g, %g", z,
                          host.driving_slope(h, z), own.driving_slope(o, z));
            const double by_mixity = own.dissipated_slope_mixity(b, z);
            ck_assert(std::abs(host.dissipated_slope_mixity(b, z) - by_mixity) <= 1e-12 * o.total);
            for (const double old : {1.0, 0.6, 0.0}) {
                ck_assert(std::abs(host.minimiser(h, y * 1.001, old) - own.minimiser(o, y * 1.001, old)) <= 1e-14);
                ck_assert(std::abs(host.slope(h, y * 1.001, old) - own.slope(o, y * 1.001, old)) <= 1e-14);
            }
        }
    }
}

TEST(endless_softening) {
    Law shape;
    delam::softening_of("exponential", shape.softening);
    const Law law = given(exponential_adhesion, exponential_dissipation, &shape);
    const std::string text = refusal([&] { validate(law); });
    ck_assert_msg(text.empty(), "%s", text.c_str());
    ck_assert(std::isinf(law.driving(law.toughness(0.0), 0.0)));
}

TEST(failures) {
    laws::Bilinear data;
    data.failing = 17;
    const Law law = given(laws::adhesion, laws::dissipation, &data);
    expect(refusal([&] { validate(law); }), "the dissipation callback failed with 17 at mixity B = 1, zeta = ");
    expect(refusal([&] {
               law.minimiser({1.0, 2.0, 0.95}, 3.0, 1.0);
           }),
           "the adhesion callback failed with 17 at mixity B = 0.95, Y = 3");
    expect(refusal([&] { law.toughness(0.91); }), "the dissipation callback failed with 17");
    ck_assert(law.toughness(0.5).onset > 0.0);
}

TEST(inconsistent_callbacks) {
    const struct {
        Fault fault;
        const char* says;
    } cases[] = {{zeta_high, "not the minimiser of zeta Y + g: too high"},
                 {zeta_low, "not the minimiser of zeta Y + g: too low"},
                 {zeta_slope, "the slope of the adhesion is not its derivative"},
                 {zeta_grows, "adhesion"},
                 {zeta_outside, "adhesion -0.1 is outside 0 .. 1"},
                 {g_offset, "g(1) must be 0"},
                 {g_slope, "g is not convex, or its slope is not its derivative"},
                 {g_concave, "the toughness g(0) is below the onset"},
                 {g_mixity, "the derivative of g by the mixity is wrong"},
                 {g_nan, "dissipated energy nan must be finite"}};
    for (const auto& c : cases) {
        Spoilt spoilt{{}, c.fault};
        const Law law = given(spoilt_adhesion, spoilt_dissipation, &spoilt);
        expect(refusal([&] { validate(law); }), c.says);
        spoilt.fault = none;
        const std::string text = refusal([&] { validate(law); });
        ck_assert_msg(text.empty(), "%s", text.c_str());
    }
    // Also during an analysis.
    Spoilt spoilt{{}, none};
    const Law law = given(spoilt_adhesion, spoilt_dissipation, &spoilt);
    const Toughness t = law.toughness(0.5);
    spoilt.fault = g_negative;
    expect(refusal([&] { law.toughness(0.5); }), "dissipated energy -1 must be >= 0 at mixity B = 0.5, zeta = 0");
    expect(refusal([&] { law.dissipated(t, 0.25); }),
           "dissipated energy -1 must be >= 0 at mixity B = 0.5, zeta = 0.25");
}

TEST(stiffness_is_needed) {
    laws::Bilinear data;
    Law law = given(laws::adhesion, laws::dissipation, &data);
    law.tangential_stiffness = 0.0;
    const std::string text = refusal([&] { validate(law); });
    ck_assert_msg(text.find("tangential_stiffness 0: must be finite and > 0") != std::string::npos, "%s", text.c_str());
    ck_assert(!set_parameter(law, "normal_onset", 1.0) && set_parameter(law, "gradient", 0.1) &&
              set_parameter(law, "tangential_stiffness", 1.0));
}
