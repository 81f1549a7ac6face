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
    std::vector<FollowedParameter> loads(count);
    Sensitivity by;
    by.conjugate.assign(count * count, 0.0);
    by.adhesion.assign(count * pairs, 0.0);
    by.mixity.assign(count * pairs, 0.0);
    State at = before;
    for (const StepPart& part : parts) {
        const double share = (part.time - before.time) / (parts.back().time - before.time);
        for (std::size_t q = 0; q < count; ++q) {
            loads[q].law.assign(pairs, -1);
            loads[q].load.assign(count, 0.0);
            loads[q].load[q] = share;
        }
        at.sensitivity = {};
        State next = stepper.step(at, part.time, {}, part.stride).state;
        at.sensitivity = std::move(by);
        by = sensitivity(Linearised(stepper.op(), stepper.pairs(), stepper.contact(), next), loads, patterns,
                         stepper.increment(at, next.mixity).get());
        at = std::move(next);
        --at.step;  // the parts of a step share its number
    }
    std::vector<double> matrix(count * count);
    for (std::size_t q = 0; q < count; ++q)
        for (std::size_t p = 0; p < count; ++p) matrix[p * count + q] = by.conjugate[q * count + p];
    return matrix;
}

}  // namespace delam
