// SPDX-License-Identifier: BSD-3-Clause
#include "interface/law.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "delam/delam.h"

namespace delam {

namespace {

struct Parameter {
    const char* name;
    double Law::*value;
};
constexpr Parameter parameters[] = {
    {"normal_stiffness", &Law::normal_stiffness},
    {"tangential_stiffness", &Law::tangential_stiffness},
    {"normal_onset", &Law::normal_onset},
    {"tangential_onset", &Law::tangential_onset},
    {"normal_toughness", &Law::normal_toughness},
    {"tangential_toughness", &Law::tangential_toughness},
    {"onset_exponent_1", &Law::onset_exponent_1},
    {"onset_exponent_2", &Law::onset_exponent_2},
    {"toughness_exponent_1", &Law::toughness_exponent_1},
    {"toughness_exponent_2", &Law::toughness_exponent_2},
};

constexpr double rounding = 1e-12;  // by how much, relatively, Gc may fall short of Go

// The natural coordinate of a mixity is x = ln(psi^2), B = 1/(1+exp(-x)): either toughness runs from one asymptote to
// the other around its own crossing psi^2 = G_t/G_n, over a width of one over the exponents. The range is what
// doubles can tell.
double mixity_of(double x) { return 1.0 / (1.0 + std::exp(-x)); }
double excess(const Law& law, double x) {
    const double b = mixity_of(x);
    const double onset = toughness_at(law.criterion, law.onset_modes(), b);
    return std::log(toughness_at(law.criterion, law.total_modes(), b) / onset);
}

// Smallest ln(Gc/Go) over the mixities between the pure modes: where, how much. Sampled evenly in B, and around both
// crossings with a spacing that grows with the distance; the deepest dips of the samples are then refined by golden
// sections.
std::pair<double, double> least_excess(const Law& law) {
    constexpr double lowest = -740.0;
    constexpr double highest = 36.5;
    std::vector<double> x{lowest, highest};
    for (int i = 1; i < 1024; ++i) x.push_back(std::log(i / (1024.0 - i)));
    for (const double crossing : {std::log(law.tangential_onset / law.normal_onset),
                                  std::log(law.tangential_toughness / law.normal_toughness)}) {
        x.push_back(crossing);
        for (double distance = 0.002; distance < 1500.0; distance += 0.002 + 0.02 * distance) {
            x.push_back(crossing - distance);
            x.push_back(crossing + distance);
        }
    }
    std::erase_if(x, [](double v) { return !(v >= lowest && v <= highest); });
    std::sort(x.begin(), x.end());

    std::vector<double> y(x.size());
    std::transform(x.begin(), x.end(), y.begin(), [&](double v) { return excess(law, v); });
    std::vector<std::size_t> dips;
    for (std::size_t i = 1; i + 1 < x.size(); ++i)
        if (y[i] <= y[i - 1] && y[i] <= y[i + 1]) dips.push_back(i);
    std::sort(dips.begin(), dips.end(), [&](std::size_t i, std::size_t j) { return y[i] < y[j]; });
    if (dips.size() > 16) dips.resize(16);

    const auto first = static_cast<std::size_t>(std::min_element(y.begin(), y.end()) - y.begin());
    std::pair<double, double> least{x[first], y[first]};
    constexpr double golden = 0.6180339887498949;
    for (const std::size_t i : dips) {
        double a = x[i - 1];
        double b = x[i + 1];
        for (int k = 0; k < 60; ++k) {
            const double c = b - golden * (b - a);
            const double d = a + golden * (b - a);
            const double fc = excess(law, c);
            const double fd = excess(law, d);
            least =
                std::min({least, {c, fc}, {d, fd}}, [](const auto& u, const auto& v) { return u.second < v.second; });
            if (fc < fd) b = d;
            else a = c;
        }
    }
    return least;
}

}  // namespace

bool Law::set(const std::string& key, double value) {
    for (const Parameter& p : parameters) {
        if (key != p.name) continue;
        this->*p.value = value;
        return true;
    }
    return false;
}

void Law::validate() const {
    for (const Parameter& p : parameters) {
        const double value = this->*p.value;
        if (!(value > 0.0 && std::isfinite(value)))
            fail(DELAM_ERROR_PROBLEM, "law: ", p.name, " ", value, ": must be finite and > 0");
    }
    if (normal_toughness < normal_onset * (1.0 - rounding))
        fail(DELAM_ERROR_PROBLEM, "law: normal_toughness ", normal_toughness, " < normal_onset ", normal_onset);
    if (tangential_toughness < tangential_onset * (1.0 - rounding))
        fail(DELAM_ERROR_PROBLEM, "law: tangential_toughness ", tangential_toughness, " < tangential_onset ",
             tangential_onset);

    // G(B) grows with G_n and G_t, so with the same exponents on both sides the pure modes decide. With different ones
    // Gc may dip below Go in between.
    if (onset_exponent_1 == toughness_exponent_1 && onset_exponent_2 == toughness_exponent_2) return;
    const auto [x, value] = least_excess(*this);
    if (value >= -rounding) return;
    const double b = mixity_of(x);
    fail(DELAM_ERROR_PROBLEM, "law: toughness ", toughness_at(criterion, total_modes(), b), " < onset ",
         toughness_at(criterion, onset_modes(), b), " at mixity B = ", b,
         " although the pure modes are fine: Gc(B) >= Go(B) is needed for every B in [0,1]; change the exponents");
}

bool Law::depends_on_mixity() const {
    return delam::depends_on_mixity(criterion, onset_modes()) || delam::depends_on_mixity(criterion, total_modes());
}

Modes Law::onset_modes() const { return {normal_onset, tangential_onset, onset_exponent_1, onset_exponent_2}; }
Modes Law::total_modes() const {
    return {normal_toughness, tangential_toughness, toughness_exponent_1, toughness_exponent_2};
}

Toughness Law::toughness(double mixity) const {
    const double onset = toughness_at(criterion, onset_modes(), mixity);
    return {onset, std::max(onset, toughness_at(criterion, total_modes(), mixity)), mixity};
}

ToughnessSlope Law::toughness_slope(double mixity) const {
    return {toughness_slope_at(criterion, onset_modes(), mixity), toughness_slope_at(criterion, total_modes(), mixity)};
}

double Law::least_onset() const { return std::min(normal_onset, tangential_onset); }

double Law::dissipated(const Toughness& t, double zeta) const {
    return std::visit([&](const auto& shape) { return shape.dissipated(t, zeta); }, softening);
}

double Law::stored_slides(const Toughness& t, double zeta) const {
    return std::visit([&](const auto& shape) { return shape.stored_slides(t, zeta); }, softening);
}

double Law::driving(const Toughness& t, double zeta) const {
    return std::visit([&](const auto& shape) { return shape.driving(t, zeta); }, softening);
}

double Law::driving_slope(const Toughness& t, double zeta) const {
    return std::visit([&](const auto& shape) { return shape.driving_slope(t, zeta); }, softening);
}

double Law::minimiser(const Toughness& t, double driving, double zeta_old) const {
    return std::visit([&](const auto& shape) { return shape.minimiser(t, driving, zeta_old); }, softening);
}

double Law::slope(const Toughness& t, double driving, double zeta_old) const {
    return std::visit([&](const auto& shape) { return shape.slope(t, driving, zeta_old); }, softening);
}

// g = Go G(Gc/Go, zeta) has degree one in the toughnesses: with a = dg/dGc, dg/dGo = (g - Gc a)/Go.
double Law::dissipated_slope_mixity(double mixity, double zeta) const {
    const Toughness t = toughness(mixity);
    const ToughnessSlope by_mixity = toughness_slope(mixity);
    return std::visit(
        [&](const auto& shape) {
            const double share = shape.total_share(t, zeta);
            return share * by_mixity.total + (shape.dissipated(t, zeta) - t.total * share) / t.onset * by_mixity.onset;
        },
        softening);
}

}  // namespace delam
