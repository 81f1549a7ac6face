// SPDX-License-Identifier: BSD-3-Clause
// A circular fibre in an infinite matrix under uniform remote stress, connected by linear springs: the exact
// plane-strain field.
#pragma once

#include <array>

namespace reference {

struct Phase {
    double young, poisson;
    double shear() const { return young / (2.0 * (1.0 + poisson)); }
    double kolosov() const { return 3.0 - 4.0 * poisson; }                                   // plane strain
    double bulk() const { return young / (2.0 * (1.0 + poisson) * (1.0 - 2.0 * poisson)); }  // lambda + mu
};

// Muskhelishvili's potentials (Some Basic Problems of the Mathematical Theory of Elasticity, par. 41 and 57; imperfect
// interface after Hashin, J. Mech. Phys. Solids 39, 1991), real by symmetry:
//     matrix  phi = G z + A/z,      psi = H z + B/z + C/z^3        (G, H: the remote stress)
//     fibre   phi = a z + c z^3,    psi = b z
//     2 mu (u + i v) = kappa phi - z conj(phi') - conj(psi)
// with continuous tractions and jumps  [u_r] = s_n sigma_rr,  [u_t] = s_t sigma_rt  at r = R. A compliance of 0 is a
// perfect bond.
class Inclusion {
public:
    // F/L2 and L3/F; free: no traction at the fibre (an open gap).
    Inclusion(Phase fibre, Phase matrix, double radius, std::array<double, 2> remote_stress, double normal_compliance,
              double tangential_compliance, bool free = false);
    // Displacement at a point, of the fibre or of the matrix.
    std::array<double, 2> displacement(bool in_fibre, double x, double y) const;
    // xx, yy, xy
    std::array<double, 3> stress(bool in_fibre, double x, double y) const;

private:
    std::array<double, 2> displacement(bool in_fibre, double x, double y, const std::array<double, 8>& c) const;
    std::array<double, 3> stress(bool in_fibre, double x, double y, const std::array<double, 8>& c) const;

    Phase fibre_, matrix_;
    double radius_;
    std::array<double, 8> coefficient_{};  // A B C a b c G H, lengths in units of R
};

// A composite cylinder (a fibre of radius R in a matrix cylinder of radius b) whose outer face moves by u_r = e b: its
// radial stress there divided by 2e, the plane-strain bulk modulus, with a radial spring compliance (L3/F) between the
// two. Lame's solution; with compliance 0 it is Hashin and Rosen's (J. Appl. Mech. 31, 1964). free: the interface
// transmits nothing.
double composite_cylinder_bulk(Phase fibre, Phase matrix, double radius, double outer, double compliance,
                               bool free = false);

}  // namespace reference
