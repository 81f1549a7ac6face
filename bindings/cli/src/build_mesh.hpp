// SPDX-License-Identifier: BSD-3-Clause
// Nodes, cells and interfaces of the library's mesh, from layers or from a mesh that was read.
#pragma once

#include "build.hpp"

namespace cli {

// Fills model.mesh and model.interfaces.
void build_mesh(Model& model, const Scene& scene);
// Initial adhesion of an interface of a mesh that was read; whether anything adheres. A pair is in a region when every
// face of the interface at it lies in the region, or when it is inside the region's box, not on its edge.
bool set_mesh_adhesion(const Model& model, const Scene& scene, std::int64_t index, const InterfaceData& data);

}  // namespace cli
