// SPDX-License-Identifier: BSD-3-Clause
// Builds the library's objects from a scene.
#pragma once

#include "model/library/model.hpp"

namespace cli {

// Returns a law of a scene, checked.
Law law_of(const Model& model, const LawData& from);
// Returns a complete and checked problem. Errors name the place in the scene.
Model build(Context context, const Scene& scene);
// Factors the operator; the state is the initial one. converged: whether its displacement step converged. former: of
// the same context, or null; its condensed bodies are used again if they are the same, and else it is destroyed first.
Solver new_solver(const Model& model, const Scene& scene, Solver former, bool& converged);

}  // namespace cli
