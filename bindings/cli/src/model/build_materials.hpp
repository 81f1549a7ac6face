// SPDX-License-Identifier: BSD-3-Clause
// Sets the materials of the bodies in the problem, and the tangents of interfaces in its mesh.
#pragma once

#include "delam/delam.h"
#include "model/library/model.hpp"
#include "scene/scene.hpp"

namespace cli {

// made_of_it: the layer or body, with its axes and formulation.
void set_material(const delam_context* owner, delam_problem* problem, std::int32_t body, const Material& material,
                  const Layer& made_of_it);
// The axes of each ply of layer `body`: a block of layers has its cells from the bottom up, as many in each level.
void set_plies(const Model& model, const Scene& scene, std::size_t body);
// True if the cells of a body have axes of their own in its mesh, and its material tells directions.
bool has_cell_axes(const Scene& scene, std::size_t body);
// The axes that the mesh gives for each cell of the body.
void set_cell_axes(const delam_context* owner, delam_problem* problem, std::int32_t body, const MeshData& mesh,
                   const Place& place);

// Turns the tangents of interfaces to the axes of their laws, before the problem takes the mesh: along `shear_axis`
// where it is given; else, under a law with two stiffnesses in shear, along axis 1 of the material of side a, or as
// they are where it has none.
void set_tangents(Model& model, const Scene& scene);

}  // namespace cli
