// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/analysis/parts_tangent.hpp"

#include <utility>

#include "base/error.hpp"
#include "delam/delam.h"
#include "evolution/derivative/sensitivity.hpp"

namespace delam {

std::vector<double> parts_tangent(Stepper& stepper, std::span<const Pattern> patterns, const State& before,
                                  std::span<const StepPart> parts) {
    if (!stepper.increment(before, before.mixity)->quadratic())
        fail(DELAM_ERROR_STATE, "step tangent: not available, because the step was divided into ", parts.size(),
             " substeps (step_control, jump_tolerance or mixity_step_tolerance), and mixity_rule = variational");
    const std::size_t count = patterns.size(), pairs = before.adhesion.size();
    Sensitivity by;
    by.conjugate.assign(count * count, 0.0);
    by.adhesion.assign(count * pairs, 0.0);
    by.mixity.assign(count * pairs, 0.0);
    by.second.assign(count * pairs, 0.0);
    State at = before;
    for (const StepPart& part : parts) {
        const double share = (part.time - before.time) / (parts.back().time - before.time);
        at.sensitivity = {};
        State next = stepper.step(at, part.time, {}, part.stride).state;
        at.sensitivity = std::move(by);
        by = stepper.differentiate(at, next, followed_loads(count, pairs, share));
        at = std::move(next);
        --at.step;  // the parts of a step share its number
    }
    return by_loads(by, count);
}

}  // namespace delam
