// SPDX-License-Identifier: BSD-3-Clause
// From a scene to the library's objects.
#pragma once

#include "handles.hpp"
#include "scene.hpp"

namespace cli {

// Order matters: the context outlives what was made with it.
struct Model {
    Context context;
    Mesh mesh;
    Problem problem;
};

Context new_context();
// The problem is complete and checked. Errors name the place in the scene.
Model build(Context context, const Scene& scene);
// Factors; the state is the initial one.
Solver new_solver(const Model& model, const Scene& scene);

}  // namespace cli
