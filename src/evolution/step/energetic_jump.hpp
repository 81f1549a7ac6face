// SPDX-License-Identifier: BSD-3-Clause
// Tells whether the growth of an energetic step is a jump, and at which load, from what its search has sampled
// (search/growth_profile.hpp). Edges of the hull that follow each other are one event as long as the whole is flat
// (growth_events.hpp); it is a jump by the same rule as elsewhere, whatever it releases and whichever start led to it.
#pragma once

#include <optional>
#include <span>

#include "evolution/increment/damage_step.hpp"
#include "evolution/increment/state.hpp"
#include "evolution/search/fronts.hpp"
#include "evolution/search/growth_profile.hpp"

namespace delam {

// Returns the longest jump of the step, or that it has none: `debonded` is 0. Where the loads are not in proportion,
// the hull is that at the load of the end, which is then the load of the jump. None: the step has debonded pairs
// elsewhere than where growth was sampled, or the load falls. initial: [pairs] adhesion at first.
std::optional<JumpWithin> energetic_jump(const PairLaws& pairs, const PairGraph& graph, std::span<const double> initial,
                                         std::span<const GrowthProfile> profiles, const State& before,
                                         const State& after);

}  // namespace delam
