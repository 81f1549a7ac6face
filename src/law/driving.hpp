// SPDX-License-Identifier: BSD-3-Clause
// The driving energies of one point of an interface: Y_n = k_n u_n^2 / 2 and Y_t = k_t u_t^2 / 2; with two
// stiffnesses in shear Y_t = Y_1 + Y_2 = (k_1 u_1^2 + k_2 u_2^2) / 2 along the tangents of a pair.
#pragma once

#include <span>

#include "law/law.hpp"
#include "law/mixity.hpp"

namespace delam {

struct Driving {
    double normal;        // Y_n, F/L; 0 if contact closes the point
    double tangential;    // Y_t
    double second = 0.0;  // Y_2 of a law with two toughnesses in shear, else 0: they are the same along all directions
    double total() const { return normal + tangential; }
    Mixity mixity() const { return {mode_mixity(normal, tangential), second_share(tangential, second)}; }
};

// local_jump: [dimension], the normal part first.
Driving driving_energy(const Law& law, std::span<const double> local_jump);

// True if the jump that causes Y is larger than rounding, so that it defines a mixity. largest: the largest Y of all
// pairs.
bool tells_mixity(const Law& law, const Driving& y, double largest);

// The derivatives of D(B, S, zeta), the driving energy that it takes to damage further from zeta, by the mixity B and
// by the share S of the second shear: differences of the law, which is smooth there. dD/dS is 0 for a law with one
// toughness in shear. Both are multiplied by the factor.
double driving_by_shear(const Law& law, const Mixity& mixity, double zeta, double factor = 1.0);
double driving_by_second(const Law& law, const Mixity& mixity, double zeta, double factor = 1.0);

// Relative rounding of an energy: the square of 1e-10 of a jump.
inline constexpr double driving_rounding = 1e-20;

}  // namespace delam
