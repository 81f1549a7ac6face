// SPDX-License-Identifier: BSD-3-Clause
// A jump of the state between two instants of the analysis, and where its energy went.
#pragma once

#include <cstdint>
#include <vector>

#include "evolution/increment/damage_step.hpp"
#include "evolution/increment/state.hpp"
#include "evolution/search/fronts.hpp"

namespace delam {

struct JumpEvent {
    std::int64_t step;    // load step
    double before, time;  // the jump lies between these two
    double stored;        // change of stored energy and load potential, F L
    double dissipated;
    double released;                                        // neither stored nor dissipated, >= 0
    double debonded;                                        // change of sum w (1 - zeta), L or L2
    std::int64_t interface;                                 // the one that changed most
    std::int64_t first_pair, last_pair;                     // of that interface, with changed adhesion
    std::vector<double> conjugate_before, conjugate_after;  // [patterns] dE/dtheta
};

// Describes the jump between two states.
JumpEvent describe_jump(const PairLaws& pairs, const PairGraph& graph, const State& before, const State& after);
// True if a front is farther on in the second state by more than one row of pairs.
bool moves_far(const PairLaws& pairs, const PairGraph& graph, const State& before, const State& after);
// True if the state jumps in a step: the step releases energy worth mentioning, or loses load, as a front moves by more
// than one row of pairs.
bool jumps(const PairLaws& pairs, const PairGraph& graph, const State& before, const State& after);
// True if a step damages pairs and its work, that of the reactions at both ends, differs much from what it stores,
// dissipates and releases.
bool leaves_open(const State& before, const State& after);
// True if that is more than this share of what it dissipates, and all steps together leave more than this share open of
// all that is dissipated.
bool leaves_open(const State& before, const State& after, double accuracy);
// True if a step may hold a jump of which its energies do not tell: its work is that of the reactions at both ends, and
// differs much from what it stores, dissipates and releases, or its load falls to less than half, as a front moves by
// more than one row.
bool hides_jump(const PairLaws& pairs, const PairGraph& graph, const State& before, const State& after);

}  // namespace delam
