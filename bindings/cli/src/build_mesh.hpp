// SPDX-License-Identifier: BSD-3-Clause
// Nodes, cells and interfaces of the library's mesh, from layers or from a mesh file.
#pragma once

#include "build.hpp"

namespace cli {

// Fills model.mesh and model.interfaces.
void build_mesh(Model& model, const Scene& scene);
// Sets the initial adhesion of an interface of a mesh file; returns whether any pair adheres. A pair lies in a region
// if all adjacent faces of the interface lie in the region, or if it is inside the region's box, not on its edge.
bool set_mesh_adhesion(const Model& model, const Scene& scene, std::int64_t index, const InterfaceData& data);

}  // namespace cli
