// SPDX-License-Identifier: BSD-3-Clause
#include "result/history/revision.hpp"

#include <algorithm>
#include <string>

#include "model/library/call.hpp"

namespace cli {

std::int64_t revised_from(const Model& model, delam_solver* solver, std::int64_t step) {
    double first = 0;
    call(model.context.get(), delam_solver_value(solver, "revised_from", &first), std::string("value revised_from"));
    return std::min(static_cast<std::int64_t>(first), step);
}

SelectedStep::SelectedStep(const Model& model, delam_solver* solver, std::int64_t step) : solver_(solver) {
    call(model.context.get(), delam_solver_look(solver, step), "select step " + std::to_string(step));
}

SelectedStep::~SelectedStep() { delam_solver_look(solver_, -1); }

}  // namespace cli
