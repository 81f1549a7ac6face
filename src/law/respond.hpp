// SPDX-License-Identifier: BSD-3-Clause
// The answer of a law at one open point of an interface.
#pragma once

#include <array>
#include <span>

#include "law/law.hpp"

namespace delam {

struct PointResponse {
    double adhesion;                 // after the damage of this jump
    std::array<double, 3> traction;  // zeta k_c u_c, F/L2; the first [dimension] entries
};

// local_jump: [dimension], the normal part first and >= 0. mixity: B; the share of the second shear is that of the
// jump.
PointResponse respond(const Law& law, std::span<const double> local_jump, double mixity, double adhesion_old);

}  // namespace delam
