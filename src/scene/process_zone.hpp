// SPDX-License-Identifier: BSD-3-Clause
// How long the process zone of an interface will be, before anything is solved.
#pragma once

#include <cstdint>

#include "scene/problem.hpp"

namespace delam {

// With peak traction s = sqrt(2 k Go) and toughness Gc of a pure mode, l = E' Gc / s^2 in a thick body; in slender arms
// of thickness h < l l^(1/4) h^(3/4) in mode I, (l h)^(1/2) in mode II (Yang and Cox, Int. J. Fract. 133, 2005). The
// shorter mode counts, and the body in which it is shorter. E': E/(1 - nu^2), in plane stress E, of an orthotropic body
// its smallest Young's modulus; h: volume of the body over area of the interface.
struct ProcessZone {
    double length = 0.0;   // 0: no softening law
    double spacing = 0.0;  // mean distance of its pairs that adhere at first
};
ProcessZone predicted_process_zone(const Problem& problem, std::int64_t interface);

}  // namespace delam
