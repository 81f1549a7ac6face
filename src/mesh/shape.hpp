// SPDX-License-Identifier: BSD-3-Clause
// Shape functions of the four cell types on their reference cells: the triangle or tetrahedron with corners 0, e1, e2
// (, e3), the square [-1,1]^2 and the cube [-1,1]^3; corners in the order of VTK.
#pragma once

#include <array>
#include <span>

#include "mesh/mesh.hpp"

namespace delam {

using ReferencePoint = std::array<double, 3>;

// Quadrature on the reference cell: Gauss, exact for the stiffness of an undistorted cell. Equal weights.
struct Quadrature {
    std::span<const ReferencePoint> points;
    double weight;
};
Quadrature quadrature(CellType type);
std::span<const ReferencePoint> corners(CellType type);
const ReferencePoint& centre(CellType type);

// dN/dxi at a reference point: [nodes][dimension].
using ShapeGradient = std::array<double, 24>;
ShapeGradient reference_gradient(CellType type, const ReferencePoint& at);

// dN/dx at a reference point, and the determinant of dx/dxi. coordinates: [nodes][dimension].
struct PhysicalGradient {
    ShapeGradient gradient;
    double jacobian;
};
PhysicalGradient physical_gradient(CellType type, std::span<const double> coordinates, const ReferencePoint& at);

// Smallest Jacobian determinant over the quadrature points and corners; <= 0: inverted or degenerate.
double smallest_jacobian(CellType type, std::span<const double> coordinates);

}  // namespace delam
