// SPDX-License-Identifier: BSD-3-Clause
// Mode mixity B = Y_t / (Y_n + Y_t) = psi^2/(1+psi^2) in [0,1].
#pragma once

namespace delam {

// Zero jump means 0/0: mode I by convention. normal, tangential: Y_n, Y_t >= 0.
double mode_mixity(double normal, double tangential);

}  // namespace delam
