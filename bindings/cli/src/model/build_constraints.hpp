// SPDX-License-Identifier: BSD-3-Clause
// Adds equations, couplings and periodic cells of the scene to the problem.
#pragma once

#include <array>

#include "model/library/model.hpp"

namespace cli {

// To be called after the patterns.
void add_constraints(Model& model, const Scene& scene);

// Volume (2D: area) of the cell: that of its periods times the extent of the mesh in the other directions.
double cell_volume(const Model& model, const Scene& scene);
// Average strain of the cell, including openings of interfaces: xx, yy, zz, xy, yz, zx, shears doubled. From the
// control nodes alone.
std::array<double, 6> cell_strain(const Model& model, const Scene& scene, delam_solver* solver);

}  // namespace cli
