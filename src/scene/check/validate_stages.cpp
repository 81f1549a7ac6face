// SPDX-License-Identifier: BSD-3-Clause
#include "scene/check/validate_stages.hpp"

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "scene/check/validate.hpp"
#include "scene/stage.hpp"

namespace delam {

void validate_stages(const Problem& problem, double time, const Poll& poll) {
    if (changes_of(problem).empty()) return validate(problem, poll);
    validate(scene_from(problem, time), poll);
    for (double from = next_change(problem, time); from < infinite; from = next_change(problem, from)) {
        try {
            validate(scene_from(problem, from), poll);
        } catch (const Error& error) {
            if (error.status() != DELAM_ERROR_PROBLEM) throw;
            fail(error.status(), "from time ", from, " on, where supports begin or end: ", error.what());
        }
    }
    if (problem.engine != nullptr && has_stages(problem, time))
        fail(DELAM_ERROR_PROBLEM, "supports begin or end at time ", next_change(problem, time),
             ", which an engine of the host does not know");
}

}  // namespace delam
