// SPDX-License-Identifier: BSD-3-Clause
// Shape functions of the cell types on their reference cells: the triangle or tetrahedron with corners 0, e1, e2
// (, e3), the square [-1,1]^2 and the cube [-1,1]^3, for wedges the triangle times [-1,1], and for pyramids the cube
// whose upper face is mapped to the apex; nodes in the order of VTK.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesh/cell_type.hpp"

namespace delam {

using ReferencePoint = std::array<double, 3>;
using ShapeValues = std::array<double, most_cell_nodes>;
// dN/dxi or dN/dx: [nodes][dimension].
using ShapeGradient = std::array<double, 3 * most_cell_nodes>;

// Gauss quadrature on the reference cell with the gradients dN/dxi at its points. It integrates the stiffness of an
// undistorted cell exactly and, on any cell, even a curved one, int dN_a/dx dx, so that constant stresses are in
// equilibrium (the patch test). All weights are positive. No point is at the apex of a pyramid, where nothing has a
// derivative.
struct Quadrature {
    std::vector<ReferencePoint> points;
    std::vector<double> weights;
    std::vector<ShapeGradient> gradients;
};
const Quadrature& quadrature(CellType type);

// Returns the places of the nodes of a cell on its reference cell.
std::span<const ReferencePoint> reference_nodes(CellType type);
const ReferencePoint& centre(CellType type);
const ShapeGradient& centre_gradient(CellType type);  // dN/dxi there

ShapeValues shape_values(CellType type, const ReferencePoint& at);
ShapeGradient reference_gradient(CellType type, const ReferencePoint& at);

// dN/dx where dN/dxi is on_reference, and the determinant of dx/dxi. coordinates: [nodes][dimension].
struct PhysicalGradient {
    ShapeGradient gradient;  // entries behind those of the cell's nodes are undefined
    double jacobian;
};
PhysicalGradient physical_gradient(CellType type, std::span<const double> coordinates,
                                   const ShapeGradient& on_reference);
// The determinant alone.
double jacobian(CellType type, std::span<const double> coordinates, const ShapeGradient& on_reference);

// Smallest Jacobian determinant over the quadrature points and nodes, but for the apex of a pyramid, where it is always
// 0; <= 0: inverted or degenerate.
double smallest_jacobian(CellType type, std::span<const double> coordinates);

}  // namespace delam
