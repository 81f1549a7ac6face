// SPDX-License-Identifier: BSD-3-Clause
#include "revision.hpp"

#include <string>
#include <string_view>

#include "call.hpp"

// Until the library has it; then the header's declaration stands and this one goes.
extern "C" __attribute__((weak)) std::int32_t delam_solver_look(delam_solver* solver, std::int64_t step);

namespace cli {

namespace {

bool knows(const delam_context* context, const delam_solver* solver, std::string_view key) {
    std::int64_t count = 0;
    call(context, delam_solver_value_count(solver, &count), std::string("values of the solver"));
    for (std::int64_t i = 0; i < count; ++i)
        if (const char* name = delam_solver_value_name(solver, i); name != nullptr && name == key) return true;
    return false;
}

}  // namespace

std::int64_t revised_from(const Model& model, delam_solver* solver, std::int64_t step) {
    const delam_context* context = model.context.get();
    if (!knows(context, solver, "revised_from")) return step;
    double first = 0;
    call(context, delam_solver_value(solver, "revised_from", &first), std::string("value revised_from"));
    return static_cast<std::int64_t>(first);
}

Look::Look(const Model& model, delam_solver* solver, std::int64_t step) : solver_(solver) {
    call(model.context.get(), delam_solver_look(solver, step), "look at step " + std::to_string(step));
}

Look::~Look() { delam_solver_look(solver_, -1); }

}  // namespace cli
