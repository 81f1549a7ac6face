// SPDX-License-Identifier: BSD-3-Clause
// The piecewise-linear (bilinear) decohesion law in energetic form, as pure functions of one point.
//
// With Y = Y_n + Y_t, Y_c = k_c [u]_c^2 / 2, and onset and total toughness Go, Gc at the mixity B = Y_t/Y:
//   stored       zeta Y                         dissipated   g(zeta) = Gc Go (1-zeta) / (Go + D zeta),  D = Gc - Go
//   or (slides)  zeta Y + f(zeta)               dissipated   Gc (zeta_old - zeta),
//                f(zeta) = -Gc D zeta (1-zeta) / (Go + D zeta)
// Both splits have the same minimiser over 0 <= zeta <= zeta_old:
//   zeta = clamp((Gc sqrt(Go/Y) - Go) / D, 0, zeta_old);   D = 0: zeta_old while Y < Gc, else 0.
#pragma once

#include <string>

namespace delam {

// Toughness at one mixity, F/L.
struct Toughness {
    double onset;  // Go
    double total;  // Gc >= Go
};

struct Law {
    double normal_stiffness = 0.0;      // k_n, F/L3
    double tangential_stiffness = 0.0;  // k_t
    double normal_onset = 0.0;          // G^o_n, F/L
    double tangential_onset = 0.0;
    double normal_toughness = 0.0;  // G^c_n
    double tangential_toughness = 0.0;
    double onset_exponent_1 = 2.0;  // a1, a2: onset criterion
    double onset_exponent_2 = 2.0;
    double toughness_exponent_1 = 2.0;  // b1, b2: total toughness criterion
    double toughness_exponent_2 = 2.0;
    double gradient = 0.0;  // kappa >= 0 of the stored energy kappa/2 |grad zeta|^2, F L (gradient.hpp)

    // Sets a parameter by its public name (delam_law_set); false: unknown name.
    bool set(const std::string& key, double value);
    // Is 0 an admissible value of the parameter?
    static bool may_be_zero(const std::string& key);
    // Throws Error(DELAM_ERROR_PROBLEM) naming the parameter, its value and range, or the mixity where Gc(B) < Go(B).
    void validate() const;
    // False: Go and Gc are the same at every mixity, which is so for equal pure modes and exponents of 1 (nothing else
    // keeps (1-B)^p + B^q = 1 for every B).
    bool depends_on_mixity() const;
    // 0 <= mixity <= 1.
    Toughness toughness(double mixity) const;
};

// Energies per unit area at one point; `t` at the mixity that holds.
double dissipated(const Toughness& t, double zeta);              // g(zeta), g(1) = 0
double driving(const Toughness& t, double zeta);                 // Y(zeta) = -dg/dzeta: what it takes to damage from zeta on
double driving_slope(const Toughness& t, double zeta);           // dY/dzeta <= 0
double stored_slides(const Toughness& t, double zeta);           // f(zeta) <= 0
double damage_minimiser(const Toughness& t, double driving, double zeta_old);  // driving = Y
// d zeta/dY of the minimiser where 0 < zeta < zeta_old, else 0; < 0.
double damage_slope(const Toughness& t, double driving, double zeta_old);

}  // namespace delam
