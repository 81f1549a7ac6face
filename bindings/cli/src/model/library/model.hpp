// SPDX-License-Identifier: BSD-3-Clause
// The objects of the library that a scene describes.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "delam/delam.h"
#include "scene/scene.hpp"

namespace cli {

// Owners of the library's handles.
template <class T, void (*Destroy)(T**)>
struct Destroyer {
    void operator()(T* handle) const noexcept { Destroy(&handle); }
};

using Context = std::unique_ptr<delam_context, Destroyer<delam_context, delam_context_destroy>>;
using Mesh = std::unique_ptr<delam_mesh, Destroyer<delam_mesh, delam_mesh_destroy>>;
using Law = std::unique_ptr<delam_law, Destroyer<delam_law, delam_law_destroy>>;
using Problem = std::unique_ptr<delam_problem, Destroyer<delam_problem, delam_problem_destroy>>;
using Solver = std::unique_ptr<delam_solver, Destroyer<delam_solver, delam_solver_destroy>>;

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
// Notes what the next interface of the mesh is: that of bodies a and b.
void push_interface(Model& model, const Scene& scene, InterfaceData data, std::size_t a, std::size_t b);
// Returns the number of patterns of the problem: those of the scene, then that of initial gaps if there are any.
std::size_t pattern_count(const Model& model);
Context new_context();

// The two nodes of each pair of an interface.
struct PairNodes {
    std::vector<std::int64_t> a, b;
};
// Returns the nodes of the faces at which the pairs are: at a mid-side node a pair has tied nodes of the same original.
PairNodes nodes_of_pairs(const Model& model, std::int64_t interface, const std::string& what);

}  // namespace cli
