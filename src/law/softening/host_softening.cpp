// SPDX-License-Identifier: BSD-3-Clause
#include "law/softening/host_softening.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace delam {

namespace {

constexpr double mixity_step = 1e-5;    // of the difference quotient of the onset
constexpr double adhesion_step = 1e-6;  // of the difference quotient of Y(zeta), where the callback's slope is cut off

[[noreturn]] void refuse(const HostSoftening& law, const std::string& what, double mixity, const char* variable,
                         double at) {
    fail(DELAM_ERROR_PROBLEM, "law '", law.name, "': ", what, " at mixity B = ", mixity, ", ", variable, " = ", at);
}

}  // namespace

HostSoftening::Adhesion HostSoftening::adhesion(double mixity, double driving) const {
    Adhesion out{NAN, NAN};
    if (const std::int32_t failure = adhesion_callback(mixity, driving, &out.value, &out.slope, user); failure != 0)
        refuse(*this, text("the adhesion callback failed with ", failure), mixity, "Y", driving);
    if (!(out.value >= 0.0 && out.value <= 1.0))
        refuse(*this, text("adhesion ", out.value, " is outside 0 .. 1"), mixity, "Y", driving);
    if (!(out.slope <= 0.0 && std::isfinite(out.slope)))
        refuse(*this, text("slope of the adhesion ", out.slope, " must be finite and <= 0"), mixity, "Y", driving);
    return out;
}

HostSoftening::Dissipation HostSoftening::dissipation(double mixity, double zeta) const {
    Dissipation out{NAN, NAN, NAN};
    const std::int32_t failure = dissipation_callback(mixity, zeta, &out.value, &out.slope, &out.mixity_slope, user);
    if (failure != 0) refuse(*this, text("the dissipation callback failed with ", failure), mixity, "zeta", zeta);
    if (!std::isfinite(out.value))
        refuse(*this, text("dissipated energy ", out.value, " must be finite"), mixity, "zeta", zeta);
    if (!(out.slope <= 0.0) || (zeta > 0.0 && !std::isfinite(out.slope)))
        refuse(*this, text("slope of the dissipated energy ", out.slope, " must be finite and <= 0"), mixity, "zeta",
               zeta);
    if (!std::isfinite(out.mixity_slope))
        refuse(*this, text("derivative of the dissipated energy by the mixity ", out.mixity_slope, " must be finite"),
               mixity, "zeta", zeta);
    return out;
}

Toughness HostSoftening::toughness(double mixity) const {
    const double onset = -dissipation(mixity, 1.0).slope, total = dissipation(mixity, 0.0).value;
    if (total < 0.0) refuse(*this, text("dissipated energy ", total, " must be >= 0"), mixity, "zeta", 0.0);
    return {onset, std::max(onset, total), mixity};
}

ToughnessSlope HostSoftening::toughness_slope(double mixity) const {
    const double low = std::max(0.0, mixity - mixity_step), high = std::min(1.0, mixity + mixity_step);
    const double change = dissipation(low, 1.0).slope - dissipation(high, 1.0).slope;
    return {change / (high - low), dissipation(mixity, 0.0).mixity_slope};
}

double HostSoftening::dissipated(const Toughness& t, double zeta) const {
    const double value = dissipation(t.mixity, zeta).value;
    if (value < -close_enough * t.total)
        refuse(*this, text("dissipated energy ", value, " must be >= 0"), t.mixity, "zeta", zeta);
    return value;
}

double HostSoftening::driving(const Toughness& t, double zeta) const { return -dissipation(t.mixity, zeta).slope; }

// dY/dzeta is the reciprocal of d zeta*/dY; where the latter is cut off, at the ends, it is a difference towards the
// inside.
double HostSoftening::driving_slope(const Toughness& t, double zeta) const {
    const double y = driving(t, zeta);
    if (!std::isfinite(y)) return -y;
    if (const Adhesion at = adhesion(t.mixity, y); at.slope < 0.0) return 1.0 / at.slope;
    const double low = std::max(0.0, zeta - adhesion_step);
    return low < zeta ? std::min(0.0, (y - driving(t, low)) / (zeta - low))
                      : std::min(0.0, (driving(t, adhesion_step) - y) / adhesion_step);
}

double HostSoftening::minimiser(const Toughness& t, double driving, double zeta_old) const {
    if (driving < t.onset) return zeta_old;
    return std::min(zeta_old, adhesion(t.mixity, driving).value);
}

double HostSoftening::slope(const Toughness& t, double driving, double zeta_old) const {
    if (driving < t.onset) return 0.0;
    const Adhesion at = adhesion(t.mixity, driving);
    return at.value > 0.0 && at.value < zeta_old ? at.slope : 0.0;
}

}  // namespace delam
