// SPDX-License-Identifier: BSD-3-Clause
#include "law/law.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "delam/delam.h"

namespace delam {

void Law::set_criterion(Criterion chosen) {
    if (chosen == criterion) return;
    criterion = chosen;
    toughness_exponent_1 = toughness_exponent_2 = 2.0;
    if (!onset_criterion) onset_exponent_1 = onset_exponent_2 = 2.0;
}

void Law::set_onset_criterion(Criterion chosen) {
    if (chosen != criterion_of_onset()) onset_exponent_1 = onset_exponent_2 = 2.0;
    onset_criterion = chosen;
}

bool Law::depends_on_mixity() const {
    if (host() != nullptr) return true;
    return delam::depends_on_mixity(criterion_of_onset(), onset_modes()) ||
           delam::depends_on_mixity(criterion, total_modes());
}

namespace {

// The traction before any damage, k [u], has its peak s at the driving energy k [u]^2/2 = s^2/(2 k).
double onset_of(double given, double strength, double stiffness) {
    return strength > 0.0 ? strength / stiffness * strength / 2.0 : given;
}

}  // namespace

Modes Law::onset_modes() const {
    if (!softens()) return total_modes();
    return {onset_of(normal_onset, normal_strength, normal_stiffness),
            onset_of(tangential_onset, tangential_strength, tangential_stiffness), onset_exponent_1, onset_exponent_2,
            onset_of(second_tangential_onset, second_tangential_strength, stiffness(2))};
}
Modes Law::total_modes() const {
    return {normal_toughness, tangential_toughness, toughness_exponent_1, toughness_exponent_2,
            second_tangential_toughness};
}

bool Law::two_shear_toughnesses() const {
    if (!(second_tangential_toughness > 0.0 || second_tangential_onset > 0.0 || second_tangential_strength > 0.0) ||
        host() != nullptr)
        return false;
    return total_modes().two_shears() || onset_modes().two_shears();
}

Toughness Law::toughness(const Mixity& mixity) const {
    if (const HostSoftening* given = host()) return given->toughness(mixity.shear);
    const double onset = toughness_at(criterion_of_onset(), onset_modes(), mixity);
    return {onset, std::max(onset, toughness_at(criterion, total_modes(), mixity)), mixity.shear};
}

ToughnessSlope Law::toughness_slope(double mixity) const {
    if (const HostSoftening* given = host()) return given->toughness_slope(mixity);
    return {toughness_slope_at(criterion_of_onset(), onset_modes(), mixity),
            toughness_slope_at(criterion, total_modes(), mixity)};
}

double Law::least_onset() const {
    if (const HostSoftening* given = host()) return std::min(given->toughness(0.0).onset, given->toughness(1.0).onset);
    const Modes modes = onset_modes();
    const double least = std::min(modes.normal, modes.tangential);
    return modes.two_shears() ? std::min(least, modes.second_shear) : least;
}

double Law::onset_bound() const {
    return host() != nullptr ? 0.0 : least_toughness(criterion_of_onset(), onset_modes());
}

double Law::least_total() const { return host() != nullptr ? 0.0 : least_toughness(criterion, total_modes()); }

double Law::dissipated(const Toughness& t, double zeta) const {
    return std::visit([&](const auto& shape) { return shape.dissipated(t, zeta); }, softening);
}

double Law::stored_linear(const Toughness& t, double zeta) const {
    return std::visit(
        [&](const auto& shape) {
            if constexpr (requires { shape.stored_linear(t, zeta); })
                return shape.stored_linear(t, zeta);
            else
                return std::min(0.0, shape.dissipated(t, zeta) - t.total * (1.0 - zeta));
        },
        softening);
}

double Law::driving(const Toughness& t, double zeta) const {
    return std::visit([&](const auto& shape) { return shape.driving(t, zeta); }, softening);
}

double Law::driving_slope(const Toughness& t, double zeta) const {
    return std::visit([&](const auto& shape) { return shape.driving_slope(t, zeta); }, softening);
}

double Law::minimiser(const Toughness& t, double driving, double zeta_old) const {
    if (std::isinf(driving)) return 0.0;  // of a jump whose energy is beyond all numbers
    return std::visit([&](const auto& shape) { return shape.minimiser(t, driving, zeta_old); }, softening);
}

double Law::slope(const Toughness& t, double driving, double zeta_old) const {
    return std::visit([&](const auto& shape) { return shape.slope(t, driving, zeta_old); }, softening);
}

// g = Go G(Gc/Go, zeta) has degree one in the toughnesses: with a = dg/dGc, dg/dGo = (g - Gc a)/Go.
double Law::dissipated_slope_mixity(double mixity, double zeta) const {
    if (const HostSoftening* given = host()) return given->dissipation(mixity, zeta).mixity_slope;
    const Toughness t = toughness(mixity);
    const ToughnessSlope by_mixity = toughness_slope(mixity);
    return std::visit(
        [&](const auto& shape) {
            if constexpr (requires { shape.total_share(t, zeta); }) {
                const double share = shape.total_share(t, zeta);
                const double rest = (shape.dissipated(t, zeta) - t.total * share) / t.onset;
                return share * by_mixity.total + rest * by_mixity.onset;
            } else
                return 0.0;
        },
        softening);
}

}  // namespace delam
