// SPDX-License-Identifier: BSD-3-Clause
#include "interface/law.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "delam/delam.h"
#include "interface/mixity.hpp"

namespace delam {

namespace {

struct Parameter {
    const char* name;
    double Law::*value;
    bool may_be_zero = false;
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
    {"gradient", &Law::gradient, true},
};

bool admits(const Parameter& p, double value) { return std::isfinite(value) && (p.may_be_zero ? value >= 0.0 : value > 0.0); }

constexpr double rounding = 1e-12;  // by how much, relatively, Gc may fall short of Go

double onset_at(const Law& law, double mixity) {
    return interaction(law.normal_onset, law.tangential_onset, law.onset_exponent_1, law.onset_exponent_2, mixity);
}
double total_at(const Law& law, double mixity) {
    return interaction(law.normal_toughness, law.tangential_toughness, law.toughness_exponent_1,
                       law.toughness_exponent_2, mixity);
}

// The natural coordinate of a mixity is x = ln(psi^2), B = 1/(1+exp(-x)): either toughness runs from one asymptote to
// the other around its own crossing psi^2 = G_t/G_n, over a width of one over the exponents. The range is what
// doubles can tell.
double mixity_of(double x) { return 1.0 / (1.0 + std::exp(-x)); }
double excess(const Law& law, double x) {
    const double b = mixity_of(x);
    return std::log(total_at(law, b) / onset_at(law, b));
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

bool Law::may_be_zero(const std::string& key) {
    return std::any_of(std::begin(parameters), std::end(parameters), [&](const Parameter& p) { return key == p.name && p.may_be_zero; });
}

void Law::validate() const {
    for (const Parameter& p : parameters) {
        const double value = this->*p.value;
        if (!admits(p, value))
            fail(DELAM_ERROR_PROBLEM, "law: ", p.name, " ", value, ": must be finite and ", p.may_be_zero ? ">= 0" : "> 0");
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
    fail(DELAM_ERROR_PROBLEM, "law: toughness ", total_at(*this, b), " < onset ", onset_at(*this, b),
         " at mixity B = ", b,
         " although the pure modes are fine: Gc(B) >= Go(B) is needed for every B in [0,1]; change the exponents");
}

bool Law::depends_on_mixity() const {
    const bool linear = onset_exponent_1 == 1.0 && onset_exponent_2 == 1.0 && toughness_exponent_1 == 1.0 &&
                        toughness_exponent_2 == 1.0;
    return !linear || normal_onset != tangential_onset || normal_toughness != tangential_toughness;
}

Toughness Law::toughness(double mixity) const {
    const double onset = onset_at(*this, mixity);
    return {onset, std::max(onset, total_at(*this, mixity))};
}

double dissipated(const Toughness& t, double zeta) {
    return t.total * ((1.0 - zeta) * (t.onset / (t.onset * (1.0 - zeta) + t.total * zeta)));
}

// -g' = Gc^2 Go / (Go + D zeta)^2 and its slope.
double driving(const Toughness& t, double zeta) {
    const double part = t.total / (t.onset * (1.0 - zeta) + t.total * zeta);
    return t.onset * part * part;
}

double driving_slope(const Toughness& t, double zeta) {
    const double sum = t.onset * (1.0 - zeta) + t.total * zeta;
    return -2.0 * (t.total - t.onset) * (driving(t, zeta) / sum);
}

double stored_slides(const Toughness& t, double zeta) {
    return -(t.total - t.onset) * (zeta * (1.0 - zeta) * (t.total / (t.onset * (1.0 - zeta) + t.total * zeta)));
}

// zeta = (Gc sqrt(Go/Y) - Go)/D on the softening branch.
double damage_slope(const Toughness& t, double driving, double zeta_old) {
    const double zeta = damage_minimiser(t, driving, zeta_old);
    if (!(zeta > 0.0 && zeta < zeta_old)) return 0.0;
    return -0.5 * t.total * std::sqrt(t.onset / driving) / ((t.total - t.onset) * driving);
}

// With s = sqrt(Go/Y) the stationary point (Gc s - Go)/D is a difference of close numbers over a small one when D is
// small beside Go. Multiplied by Gc s + Go it becomes
//
//     zeta = (Gc^2/Go - Y) Go^2 / (D Y (Gc s + Go)),     Gc^2/Go - Y = (Gc - Y) + Gc D/Go,
//
// in which the only difference, Gc - Y, is exact where it matters. Written in multiples of Go, free of units.
double damage_minimiser(const Toughness& t, double driving, double zeta_old) {
    const double d = (t.total - t.onset) / t.onset;
    if (!(d > 0.0)) return driving < t.total ? zeta_old : 0.0;
    if (driving <= t.onset) return zeta_old;
    const double total = t.total / t.onset;
    const double y = driving / t.onset;
    const double beyond = (t.total - driving) / t.onset + total * d;
    if (!(beyond > 0.0)) return 0.0;
    return std::min(zeta_old, beyond / (d * y * (total / std::sqrt(y) + 1.0)));
}

}  // namespace delam
