// SPDX-License-Identifier: BSD-3-Clause
// Isoparametric elements with full quadrature: stiffness of a single cell. The shape
// functions, and with them smallest_jacobian(), are the mesh's (mesh/shape.hpp).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "body/model.hpp"
#include "mesh/mesh.hpp"
#include "mesh/shape.hpp"

namespace delam {

// Stiffness of a cell, row-major into matrix[size*size], size = nodes*dimension; DOFs dimension*local node + component;
// exactly symmetric. coordinates: [nodes][dimension]; elasticity as for elasticity_matrix(). Allocates nothing.
void element_stiffness(CellType type, std::span<const double> coordinates, std::span<const double> elasticity,
                       Formulation formulation, std::span<double> matrix);

// The same with the dilatation replaced by its projection (element.cpp). elasticity: of the dimension, plane strain;
// dilatation: the stresses xx, yy(, zz), xy(, yz, zx) of the strain xx = yy = zz = 1, in the order of elasticity; bulk:
// their part sigma_xx + sigma_yy + sigma_zz.
struct Dilatation {
    std::array<double, 6> stress{};
    double bulk = 0.0;
};
void mean_dilatation_stiffness(CellType type, std::span<const double> coordinates, std::span<const double> elasticity,
                               const Dilatation& dilatation, std::span<double> matrix);
// The projected dilatation at the centre less the displacement's own dilatation there.
double dilatation_correction(CellType type, std::span<const double> coordinates, std::span<const double> displacement);

// int dN_a/dx_j dx into integral[nodes*dimension], and the cell's volume.
double integrate_gradients(CellType type, std::span<const double> coordinates, std::span<double> integral);

}  // namespace delam
