// SPDX-License-Identifier: BSD-3-Clause
// The operator of a scene whose bodies another solver has condensed already.
#include "base/memory_limit.hpp"
#include "reduction/choice/choose.hpp"
#include "reduction/condensed/bulk.hpp"
#include "scene/advice/expected_parts.hpp"
#include "scene/check/step_control.hpp"

namespace delam {

bool shares_bodies(const Problem& problem, const Design& other) {
    const Options& options = problem.options;
    return other.bulk != nullptr && problem.engine == nullptr && options.kinematics != "corotational" &&
           options.subdomains == 0 && (options.reduction == "auto" || options.reduction == "condensed") &&
           hash_of_bodies(problem) == hash_of_bodies(other.bulk->system().problem());
}

Design design_operator(const Problem& problem, Monitor& monitor, const Design& other) {
    if (!shares_bodies(problem, other)) return design_operator(problem, monitor);
    Design design;
    ReductionChoice& choice = design.choice;
    choice = other.choice;
    choice.forced = true;
    choice.reason = "a solver that has condensed the same bodies";
    choice.memory = memory_limit(problem.options.memory_limit);
    const StepControl control = used_step_control(problem, problem.options);
    const ExpectedParts parts = expected_parts(problem, control.name == "load", control.path_step);
    ReductionCost& cost = choice.condensation;
    cost.step += (parts.per_step - choice.parts.per_step) * cost.part;
    cost.setup = cost.longest = cost.ordering = 0.0;
    choice.parts = parts;
    design.description = other.description;
    design.refusal = does_not_fit(choice);
    design.prescribed = other.prescribed;
    design.bound = other.bound;
    design.bulk = other.bulk;
    design.shared = true;
    return design;
}

}  // namespace delam
