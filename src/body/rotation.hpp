// SPDX-License-Identifier: BSD-3-Clause
// How far cells turn: small strains hold as long as that is little.
#pragma once

#include <span>
#include <vector>

#include "mesh/mesh.hpp"

namespace delam {

// Axial vector of the skew part of the displacement gradient at cell centres, rad, as [cells][1 or 3]: (u_y,x -
// u_x,y)/2 in 2D, (curl u)/2. A rotation by theta leaves a false strain of about theta^2/2. displacement: [mesh
// nodes][dimension].
std::vector<double> centre_rotation(const Mesh& mesh, std::span<const double> displacement);
// Largest length of it.
double largest_rotation(const Mesh& mesh, std::span<const double> displacement);

}  // namespace delam
