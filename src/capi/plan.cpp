// SPDX-License-Identifier: BSD-3-Clause
// Answers questions of a host about a problem without a solver: options, keys of values, the plan.
#include "evolution/analysis/plan.hpp"
#include "capi/handle/handles.hpp"
#include "evolution/observe/values.hpp"

using namespace delam;

extern "C" {

const char* delam_problem_option(const delam_problem* problem, const char* key) {
    const char* found = nullptr;
    guard(problem, [&] {
        require_pointer(key, "key");
        problem->option = problem->core->options.value_of(key);
        found = problem->option.c_str();
    });
    return found;
}

int32_t delam_problem_value_count(const delam_problem* problem, int64_t* count) {
    return guard(problem, [&] {
        require_pointer(count, "count");
        *count = static_cast<int64_t>(value_names(*problem->core).size());
    });
}

int32_t delam_problem_value_info(const delam_problem* problem, int64_t index, const char** key, const char** alias) {
    return guard(problem, [&] {
        const std::vector<std::string> names = value_names(*problem->core);
        require_index(index, static_cast<int64_t>(names.size()), 0, "index");
        problem->value_key = names[static_cast<std::size_t>(index)];
        const ValueInfo* info = find_value(problem->value_key);
        if (info == nullptr) fail(DELAM_ERROR_INTERNAL, "value ", index, " has no row");
        if (key != nullptr) *key = problem->value_key.c_str();
        if (alias != nullptr) *alias = info->alias;
    });
}

int32_t delam_problem_plan(delam_problem* problem, const char** plan, double* setup, double* memory) {
    return guard_build(problem, listed::problem_plan, [&] {
        const Forecast found = forecast(*problem->core, problem->context->monitor);
        problem->plan_words = plan_in_words(found.plan);
        if (plan != nullptr) *plan = problem->plan_words.c_str();
        if (setup != nullptr) *setup = found.setup;
        if (memory != nullptr) *memory = found.memory;
    });
}

}  // extern "C"
