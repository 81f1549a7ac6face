// SPDX-License-Identifier: BSD-3-Clause
// The material axes of each cell, where the sections of a file have orientations that differ from cell to cell.
#pragma once

#include <vector>

#include "deck/abaqus/abaqus_model.hpp"
#include "mesh/mesh_data.hpp"

namespace cli::abaqus {

// elements: [blocks of the mesh][cells]. Leaves MeshData::orientation empty if no orientation differs within a section;
// else those of one direction count too. Throws SceneFailure where a cell has no axes. Adds notes for people.
void set_cell_axes(const Model& model, const std::vector<std::vector<ElementAt>>& elements, MeshData& mesh);

}  // namespace cli::abaqus
