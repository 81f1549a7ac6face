// SPDX-License-Identifier: BSD-3-Clause
// Closing report of an analysis: jumps, energy balance, and what it did not resolve; as data, and as lines for people.
// It is made from history.csv and the state, so that a resumed run includes the steps before it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "result/closing/balance.hpp"
#include "result/closing/buckling.hpp"
#include "result/closing/free_bodies.hpp"
#include "result/closing/load_drops.hpp"
#include "result/closing/mesh_error.hpp"
#include "result/closing/mixity_error.hpp"
#include "result/closing/resolution.hpp"
#include "result/closing/rotations.hpp"
#include "result/closing/search_limits.hpp"
#include "result/fields/bulk_facts.hpp"
#include "result/history/jumps.hpp"

namespace cli {

struct Closing {
    std::vector<Jump> jumps;
    Balance balance;
    bool follows_load = false;   // within each step
    bool locates_jumps = false;  // rotations are large, and steps that may hold a jump are halved
    SmallRotations small;
    MixityError mixity_error;
    SearchLimits search;
    LoadDrops load_drops;
    std::vector<BuckledStep> buckled;
    std::vector<std::int64_t> estimate_violated, estimate_inconclusive;
    double estimate_tolerance = 0;
    std::vector<std::int64_t> front_unresolved;  // steps in which a crack grew with too few pairs in its process zone
    Waiting waiting;
    Pops pops;
    std::vector<FreeBody> free_bodies;  // at the end
    BulkFacts bulk;                     // of the steps with fields
};

// of_end: the state that the solver shows is the end, and this process knows all of it.
Closing closing_of(const Model& model, delam_solver* solver, const Scene& scene, std::string_view history,
                   const BulkFacts& bulk, bool of_end);
// Each fact once, without ends of line.
std::vector<std::string> closing_lines(const Closing& closing, const Scene& scene);

}  // namespace cli
