// SPDX-License-Identifier: BSD-3-Clause
// Owners of the library's handles.
#pragma once

#include <memory>

#include "delam/delam.h"

namespace cli {

template <class T, void (*Destroy)(T**)>
struct Destroyer {
    void operator()(T* handle) const noexcept { Destroy(&handle); }
};

using Context = std::unique_ptr<delam_context, Destroyer<delam_context, delam_context_destroy>>;
using Mesh = std::unique_ptr<delam_mesh, Destroyer<delam_mesh, delam_mesh_destroy>>;
using Law = std::unique_ptr<delam_law, Destroyer<delam_law, delam_law_destroy>>;
using Problem = std::unique_ptr<delam_problem, Destroyer<delam_problem, delam_problem_destroy>>;
using Solver = std::unique_ptr<delam_solver, Destroyer<delam_solver, delam_solver_destroy>>;

}  // namespace cli
