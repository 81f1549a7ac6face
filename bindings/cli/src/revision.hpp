// SPDX-License-Identifier: BSD-3-Clause
// Steps that backtracking took back and computed anew.
#pragma once

#include <cstdint>

#include "build.hpp"

namespace cli {

// First step whose row no longer holds after the step that was just committed; `step` itself when none was revised.
std::int64_t revised_from(const Model& model, delam_solver* solver, std::int64_t step);

// While it lives, values and fields of the solver are those of an earlier step that it keeps.
class Look {
public:
    Look(const Model& model, delam_solver* solver, std::int64_t step);
    ~Look();
    Look(const Look&) = delete;
    Look& operator=(const Look&) = delete;

private:
    delam_solver* solver_;
};

}  // namespace cli
