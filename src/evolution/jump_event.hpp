// SPDX-License-Identifier: BSD-3-Clause
// A jump of the state between two instants of the analysis, and where its energy went.
#pragma once

#include <cstdint>

namespace delam {

struct JumpEvent {
    std::int64_t step;    // load step
    double before, time;  // the jump lies between these two
    double stored;        // change of stored energy and load potential, F L
    double dissipated;
    double released;                     // neither stored nor dissipated: E(t, q_before) - E(t, q_after) - D >= 0
    double debonded;                     // change of sum w (1 - zeta), L or L2
    std::int64_t interface;              // the one that changed most
    std::int64_t first_pair, last_pair;  // of that interface, with changed adhesion
};

}  // namespace delam
