// SPDX-License-Identifier: BSD-3-Clause
// One pair under the functional of Zeman, Kruzik, Gruber (PANM 15 (2010), "Application to delamination problem")
// without changes: the mixity of the stored part follows the displacements, that of the dissipated part is the one of
// the state before,
//
//   phi(j, zeta) = zeta Y(j) + f(B(j), zeta) - Gc_before zeta,     f = g - Gc (1 - zeta),
//
// so the damage answers to Y + Gc(B) - Gc_before, and the displacements feel the additional traction f_B grad B, with
// dB/dj_n = -B k_n j_n/Y and dB/dj_t = (1-B) k_t j_t/Y. It vanishes at zeta = 0 and 1 and where contact keeps j_n = 0,
// and grows like 1/|j| towards no jump at all, where B is not defined: a jump that is rounding keeps the mixity from
// before, and no such traction.
#pragma once

#include <array>
#include <span>
#include <utility>

#include "law/driving.hpp"

namespace delam {

// df/dB at fixed zeta.
double stored_linear_slope(const Law& law, double mixity, double zeta);

struct VariationalPair {
    const Law& law;
    double mixity_before;  // of the state before
    double total_before;   // Gc_before
    double largest;        // Y of the scene that says what rounding is

    // local_jump: normal, tangent(s). Per unit area.
    double minimiser(std::span<const double> local_jump, double zeta_old) const;
    // The damage is that of the law at this toughness under Y + Gc(B) - Gc_before, which may be negative: only a
    // gradient term tells that from 0.
    std::pair<Toughness, double> damaging(std::span<const double> local_jump) const;
    double energy(std::span<const double> local_jump, double zeta) const;  // phi
    // zeta K j + f_B grad B: normal, tangent(s); what is beyond the dimension is 0.
    std::array<double, 3> force(std::span<const double> local_jump, double zeta) const;
    // Row-major derivative of the force with the damage minimised out, by differences.
    std::array<double, 9> tangent(std::span<const double> local_jump, double zeta_old) const;
    // The same with the damage held.
    std::array<double, 9> tangent_held(std::span<const double> local_jump, double zeta) const;
    // A spring mu K that bounds the curvature of f(B(j), zeta) from above near j: with x = sqrt(K) j in polar
    // coordinates, f = F(phi), the Hessian is [0, -F'; -F', F''] / (2 Y).
    double proximal(std::span<const double> local_jump, double zeta) const;

private:
    struct Mode {
        Driving driving;
        double mixity;
        bool known;  // false: the jump is rounding
    };
    Mode mode(std::span<const double> local_jump) const;
    template <class Damage>
    std::array<double, 9> slope(std::span<const double> local_jump, const Damage& damage) const;
};

}  // namespace delam
