// SPDX-License-Identifier: BSD-3-Clause
// Mode mixity B = Y_t / (Y_n + Y_t) = psi^2/(1+psi^2) in [0,1], and the interaction criterion of Valoroso and
// Champaney (2006).
#pragma once

namespace delam {

// No jump at all is 0/0: mode I by convention. normal, tangential: Y_n, Y_t >= 0.
double mode_mixity(double normal, double tangential);

// G solving ((1-B) G/G_n)^p + (B G/G_t)^q = 1. Closed form for p = q, else a bracketed root of this monotone equation.
double interaction(double normal_toughness, double tangential_toughness, double p, double q, double mixity);

}  // namespace delam
