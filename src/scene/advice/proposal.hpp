// SPDX-License-Identifier: BSD-3-Clause
// Proposed stiffness and strengths of an interface with a law.
#pragma once

#include <array>
#include <cstdint>

#include "scene/problem.hpp"

namespace delam {

// An interface of stiffness k beside a layer of thickness t and modulus E3 along the normal leaves 1/(1 + E3/(k t)) of
// the layer's stiffness (Turon, Davila, Camanho, Costa, Eng. Fract. Mech. 74 (2007) 1665-1682); with
// k = 50 E3/t that is 0.98. Of the two bodies the one with the larger E3/t counts. t is the extent of the body along
// the normal; a curved interface has none.
struct Proposal {
    double stiffness = 0.0;            // 50 E3/t; 0: unknown
    double share = 0.0;                // 1/(1 + E3/(k t)) with the normal stiffness of the law; 0: unknown
    std::array<double, 2> strength{};  // normal, tangential: the largest with enough pairs in the zone; 0: no zone
};
// pairs: in the predicted process zone (process_zone.hpp), > 0.
Proposal proposal(const Problem& problem, std::int64_t interface, double pairs);

}  // namespace delam
