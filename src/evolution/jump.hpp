// SPDX-License-Identifier: BSD-3-Clause
// A jump of the state at an instant of the march, and where its energy went.
#pragma once

#include <cstdint>

namespace delam {

struct Jump {
    std::int64_t step;    // of the march
    double before, time;  // the jump lies between these instants
    double stored;        // change of stored energy and load potential, F L
    double dissipated;
    double released;                     // what nothing stores or dissipates: E(t, q_before) - E(t, q_after) - D >= 0
    double debonded;                     // change of sum w (1 - zeta), L or L2
    std::int64_t interface;              // that has changed most
    std::int64_t first_pair, last_pair;  // of that interface, whose adhesion has changed
};

}  // namespace delam
