// SPDX-License-Identifier: BSD-3-Clause
// Change of the reactions with the load factors at the end of a step that was computed in parts.
//
// Each part ends at its share of the change of the loads. Pairs that come to rest in a part keep the adhesion, and so
// its derivative, that the part has given them; the derivatives are followed from part to part as those by parameters
// of the laws are from step to step (derivative/sensitivity.hpp).
#pragma once

#include <span>
#include <vector>

#include "evolution/step/stepper.hpp"

namespace delam {

// Returns d conjugate / d theta of the end, [patterns][patterns]. It follows the parts once more.
// Error(DELAM_ERROR_STATE): the traction depends on the mixity itself (mixity_rule = variational).
std::vector<double> parts_tangent(Stepper& stepper, std::span<const Pattern> patterns, const State& before,
                                  std::span<const StepPart> parts);

}  // namespace delam
