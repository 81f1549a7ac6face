// SPDX-License-Identifier: BSD-3-Clause
// Builds the library's objects from a scene.
#pragma once

#include <cstdint>
#include <vector>

#include "handles.hpp"
#include "scene.hpp"

namespace cli {

// The order matters: the context must outlive the objects made with it.
struct Model {
    Context context;
    Mesh mesh;
    Problem problem;
    std::vector<InterfaceData> interfaces;  // in the order of the mesh's interfaces
    std::vector<bool> adheres;              // per interface: whether any pair adheres at the start
    std::vector<std::string> said;          // warnings of the library while it was built, with places in the scene
    std::vector<Place> constraint_places;   // for each constraint of the problem: its place in the scene
    std::vector<std::int32_t> partitions;   // of each cell, from 1 on, as the mesh file has them; empty: it has none
};

// Attributes the constraints added to the problem since the last call to `place`.
void note_constraints(Model& model, const Place& place);
Context new_context();
// Returns a complete and checked problem. Errors name the place in the scene.
Model build(Context context, const Scene& scene);
// Factors the operator; the state is the initial one. converged: whether its displacement step converged.
Solver new_solver(const Model& model, const Scene& scene, bool& converged);

}  // namespace cli
