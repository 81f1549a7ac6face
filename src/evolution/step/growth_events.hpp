// SPDX-License-Identifier: BSD-3-Clause
// Tells which growth in a load step is a jump. Parts whose advance needs hardly more load,
//
//   dlnM <= eps da/A       (A: the interface; the whole of it would debond for 3 % more load),
//
// are flat, and with their neighbours, as long as the whole is flat, an event. It is a jump if it extends over more
// than 2.5 pairs of each front, or over half of the interface, whatever it releases, or over more than one pair of each
// where nothing adheres between fronts any more; else a pair that pops, because the mesh does not resolve the process
// zone.
#pragma once

#include <cstdint>
#include <vector>

#include "evolution/path/advance.hpp"
#include "evolution/step/jump_event.hpp"

namespace delam {

// A part of a load step.
struct GrowthPart {
    Advance advance;
    double rise = 0.0;   // of ln M since pairs could be damaged
    double start = 0.0;  // the instant from which on they could
    bool pops = false;   // pairs pop in it, which are no event of their own
};
// Pairs of each front. (Measured by verify/bench/constants.py with verify/cases/load_path/steps.py: half and twice
// change no digit.)
inline constexpr double pairs_of_jump = 2.5;
bool flat(const GrowthPart& part);
// True for an advance by single pairs.
bool single_pairs(const Advance& advance);

class GrowthEvents {
public:
    GrowthEvents(const PairLaws& pairs, const PairGraph& graph) : pairs_(pairs), graph_(graph) {}

    void add(const GrowthPart& part, const State& before, const State& after);
    // Ends the step.
    void end();
    std::vector<JumpEvent> jumps{};
    std::int64_t pops = 0;  // pairs that popped, about
    double popped = 0.0;    // energy that they released, F L

private:
    const PairLaws& pairs_;
    const PairGraph& graph_;
    bool open_ = false;
    GrowthPart whole_;  // the open event
    State begin_, end_;
};

}  // namespace delam
