// SPDX-License-Identifier: BSD-3-Clause
// Toughness G(B) in mixed mode, between the pure modes G_n = G(0) and G_t = G(1). B = Y_t/(Y_n + Y_t) in [0,1].
//
//   Valoroso, Champaney (2006)  ((1-B) G/G_n)^p + (B G/G_t)^q = 1
//   power law                   the same with p = q: G = [((1-B)/G_n)^p + (B/G_t)^p]^(-1/p)
//   Benzeggagh, Kenane (1996)   G = G_n + (G_t - G_n) B^eta
//
// All three increase with G_n and with G_t, and equal G_n for every B if G_n = G_t and the exponents are 1.
//
// With two toughnesses G_1 and G_2 in shear, G_t is that of the share S = Y_2/Y_t of the second shear, by the same
// criterion with an exponent of 1:
//
//   Valoroso, Champaney; power  1/G_t = (1-S)/G_1 + S/G_2
//   Benzeggagh, Kenane          G_t = G_1 + (G_2 - G_1) S
//
// With this exponent alone G_t goes to G_1 in all directions as G_2 goes to G_1, and an exchange of the two shears
// changes nothing. Three terms with q = 2 would make a pair with G_1 = G_2 tougher by sqrt(2) where it slides between
// the axes.
#pragma once

#include <string>

#include "law/mixity.hpp"

namespace delam {

enum class Criterion { valoroso_champaney, power, benzeggagh_kenane };

// Known: valoroso-champaney, power, benzeggagh-kenane. false: an unknown name.
bool criterion_of(const std::string& name, Criterion& criterion);
const char* name_of(Criterion criterion);

// One toughness (onset or total) as the criterion needs it; toughness in F/L, exponents > 0.
struct Modes {
    double normal;              // G_n
    double tangential;          // G_t, or G_1
    double first;               // p or eta
    double second;              // q; p = q for the power law, not used by Benzeggagh and Kenane
    double second_shear = 0.0;  // G_2; 0: that of `tangential`

    bool two_shears() const { return second_shear > 0.0 && second_shear != tangential; }
};
double toughness_at(Criterion criterion, const Modes& modes, const Mixity& mixity);
// The same numbers in the direction of sliding that has this share S of the second shear: G_t in place of G_1 and G_2.
Modes along(Criterion criterion, const Modes& modes, double second_share);
// Returns a number that G(B) exceeds or reaches for every B. With r = min(p, q, 1) and the shares S = (1-B) G/G_n and
// T = B G/G_t, which lie within [0,1],
//
//     1 = S^p + T^q <= S^r + T^r <= 2^(1-r) (S + T)^r,   S + T <= G / min(G_n, G_t)
//
// so that G >= 2^(1 - 1/r) min(G_n, G_t); Benzeggagh and Kenane's criterion is monotone: r = 1. G_t >= min(G_1, G_2).
double least_toughness(Criterion criterion, const Modes& modes);
// dG/dB at S = 0. Where it is infinite (an exponent below 1, at the corresponding pure mode) it is replaced by its
// value at a distance of one part in a million.
double toughness_slope_at(Criterion criterion, const Modes& modes, double mixity);
// False: G is the same number for every B and S (only then is (1-B)^p + B^q = 1 for all B).
bool depends_on_mixity(Criterion criterion, const Modes& modes);

// G solving ((1-B) G/G_n)^p + (B G/G_t)^q = 1. Closed form for p = q, else a bracketed root of this monotone equation.
double interaction(double normal_toughness, double tangential_toughness, double p, double q, double mixity);

}  // namespace delam
