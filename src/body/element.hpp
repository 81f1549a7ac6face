// SPDX-License-Identifier: BSD-3-Clause
// Isoparametric elements with full Gauss quadrature: stiffness and centre strains of a single cell.
#pragma once

#include <span>
#include <vector>

#include "mesh/mesh.hpp"

namespace delam {

// Stiffness of a cell, row-major, DOFs dimension*local node + component. coordinates: [nodes][dimension]; elasticity as of elasticity_matrix().
std::vector<double> element_stiffness(CellType type, std::span<const double> coordinates, std::span<const double> elasticity);

// Strains (engineering, order of elasticity_matrix) at the cell's centre from its nodal displacements [nodes][dimension].
std::vector<double> centre_strain(CellType type, std::span<const double> coordinates, std::span<const double> displacement);

// Smallest Jacobian determinant over the quadrature points and corners; <= 0: inverted or degenerate.
double smallest_jacobian(CellType type, std::span<const double> coordinates);

}  // namespace delam
