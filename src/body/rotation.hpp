// SPDX-License-Identifier: BSD-3-Clause
// Rotations of cells: the small-strain assumption holds as long as they are small.
#pragma once

#include <span>
#include <vector>

#include "mesh/mesh.hpp"

namespace delam {

// Axial vector of the skew part of the displacement gradient at cell centres, rad, as [cells][1 or 3]: (u_y,x -
// u_x,y)/2 in 2D, (curl u)/2 in 3D. A rotation by theta causes a spurious strain of about theta^2/2. displacement:
// [mesh nodes][dimension].
std::vector<double> centre_rotation(const Mesh& mesh, std::span<const double> displacement);
// Returns the same from displacement gradients (CentreGradients::slopes).
std::vector<double> rotations(std::span<const double> slopes, std::size_t dimension);
// Returns the largest length of such vectors of `columns` numbers.
double largest_length(std::span<const double> rotation, std::size_t columns);

}  // namespace delam
