// SPDX-License-Identifier: BSD-3-Clause
// Steps that backtracking replaced.
#pragma once

#include <cstdint>

#include "model/library/model.hpp"

namespace cli {

// The first step whose row is invalid after the step just committed; `step` itself if no step was revised.
std::int64_t revised_from(const Model& model, delam_solver* solver, std::int64_t step);

// The solver's values and fields are those of an earlier step, which it keeps, while this object exists.
class SelectedStep {
public:
    SelectedStep(const Model& model, delam_solver* solver, std::int64_t step);
    ~SelectedStep();
    SelectedStep(const SelectedStep&) = delete;
    SelectedStep& operator=(const SelectedStep&) = delete;

private:
    delam_solver* solver_;
};

}  // namespace cli
