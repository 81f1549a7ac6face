// SPDX-License-Identifier: BSD-3-Clause
#include "law/law_parameters.hpp"

#include <cmath>

namespace delam {

namespace {

constexpr unsigned bit(std::size_t index) { return 1u << index; }
constexpr unsigned any = ~0u;
constexpr unsigned trapezoidal = bit(2), tabulated = bit(3), griffith = bit(4), host = bit(5);
constexpr unsigned own = any & ~host;  // all that the library computes
constexpr unsigned softening = own & ~griffith;
constexpr unsigned two_exponents = bit(static_cast<std::size_t>(Criterion::valoroso_champaney));
constexpr unsigned one_exponent = any & ~two_exponents;

bool positive(double v) { return v > 0.0 && std::isfinite(v); }
bool not_negative(double v) { return v >= 0.0 && std::isfinite(v); }
bool below_one(double v) { return v >= 0.0 && v < 1.0; }

constexpr LawParameter number(const char* key, const char* unit, const char* initial, const char* meaning,
                              unsigned kinds, unsigned criteria, double Law::*value, double Law::*second = nullptr) {
    return {key, "real", unit, initial, "finite and > 0", meaning, kinds, criteria, value, second, positive};
}

constexpr LawParameter parameters[] = {
    {"criterion", "text", "-", "valoroso-champaney", "valoroso-champaney, power, benzeggagh-kenane",
     "how the toughness depends on the mixity B; setting another one sets the exponents to their defaults", own, any},
    number("normal_stiffness", "F/L3", "", "k_n: traction over opening before any damage", any, any,
           &Law::normal_stiffness),
    number("tangential_stiffness", "F/L3", "", "k_t: traction over slip before any damage", any, any,
           &Law::tangential_stiffness),
    number("normal_onset", "F/L", "", "G^o_n: driving energy at which damage begins in opening", softening, any,
           &Law::normal_onset),
    number("tangential_onset", "F/L", "", "G^o_t: driving energy at which damage begins in sliding", softening, any,
           &Law::tangential_onset),
    number("normal_toughness", "F/L", "", "G^c_n >= G^o_n: energy spent until debonded in opening", own, any,
           &Law::normal_toughness),
    number("tangential_toughness", "F/L", "", "G^c_t >= G^o_t: energy spent until debonded in sliding", own, any,
           &Law::tangential_toughness),
    number("onset_exponent_1", "-", "2", "p of the onset: ((1-B) G/G_n)^p + (B G/G_t)^q = 1", softening, two_exponents,
           &Law::onset_exponent_1),
    number("onset_exponent_2", "-", "2", "q of the onset", softening, two_exponents, &Law::onset_exponent_2),
    number("toughness_exponent_1", "-", "2", "p of the toughness", own, two_exponents, &Law::toughness_exponent_1),
    number("toughness_exponent_2", "-", "2", "q of the toughness", own, two_exponents, &Law::toughness_exponent_2),
    number("onset_exponent", "-", "2", "of the onset: p = q of the power law, eta of G_n + (G_t - G_n) B^eta",
           softening, one_exponent, &Law::onset_exponent_1, &Law::onset_exponent_2),
    number("toughness_exponent", "-", "2", "likewise of the toughness", own, one_exponent, &Law::toughness_exponent_1,
           &Law::toughness_exponent_2),
    {"plateau", "real", "-", "", ">= 0 and < 1",
     "part of the way from onset to end on which the traction stays at its peak", trapezoidal, any, nullptr, nullptr,
     below_one},
    {"softening", "table", "-", "", "from (0, 1) to (1, 0), first column not falling, second not rising",
     "points (xi, s): jump beyond the onset over its largest, traction over its peak; scaled so that the area is the "
     "toughness",
     tabulated, any},
    {"gradient", "real", "F L", "0", "finite and >= 0", "kappa of the gradient term kappa/2 |grad zeta|^2", any, any,
     &Law::gradient, nullptr, not_negative},
};

}  // namespace

std::span<const LawParameter> law_parameters() { return parameters; }

bool applies(const LawParameter& p, const Law& law) {
    const unsigned kind = bit(law.softening.index()), criterion = bit(static_cast<std::size_t>(law.criterion));
    return (p.kinds & kind) != 0 && (p.criteria & criterion) != 0;
}

const LawParameter* find_parameter(const Law& law, const std::string& key) {
    for (const LawParameter& p : parameters)
        if (key == p.key && applies(p, law)) return &p;
    return nullptr;
}

std::string known_parameters(const Law& law, const std::string& type) {
    std::string out;
    for (const LawParameter& p : parameters)
        if (applies(p, law) && type == p.type) out += (out.empty() ? "" : ", ") + std::string(p.key);
    return out;
}

}  // namespace delam
