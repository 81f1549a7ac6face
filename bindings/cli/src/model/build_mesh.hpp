// SPDX-License-Identifier: BSD-3-Clause
// Nodes, cells and interfaces of the library's mesh, from layers or from a mesh file.
#pragma once

#include "model/library/model.hpp"

namespace cli {

// Fills model.mesh and model.interfaces.
void build_mesh(Model& model, const Scene& scene);
// Sets the initial adhesion of the pairs in the box of a region; returns their number.
std::int64_t set_box(Model& model, std::int64_t index, const Region& region);
// Sets the initial adhesion of an interface of a mesh file, in all of its regions. A pair lies in a set if all adjacent
// faces of the interface do.
void set_mesh_regions(Model& model, const Scene& scene, std::int64_t index, const InterfaceData& data);

}  // namespace cli
