// SPDX-License-Identifier: BSD-3-Clause
// From a scene to the library's objects.
#pragma once

#include <vector>

#include "handles.hpp"
#include "scene.hpp"

namespace cli {

// Order matters: the context outlives what was made with it.
struct Model {
    Context context;
    Mesh mesh;
    Problem problem;
    std::vector<InterfaceData> interfaces;  // as the mesh has them, in its order
    std::vector<bool> adheres;              // per interface: some pair does at the start
    std::vector<Place> constraint_places;   // of each constraint of the problem: what asked for it
};

// Whatever the problem has gained of constraints is due to `place`.
void note_constraints(Model& model, const Place& place);
Context new_context();
// The problem is complete and checked. Errors name the place in the scene.
Model build(Context context, const Scene& scene);
// Factors; the state is the initial one. converged: whether its displacement did not meet a limit.
Solver new_solver(const Model& model, const Scene& scene, bool& converged);

}  // namespace cli
