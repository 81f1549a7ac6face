// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/shape.hpp"

#include <algorithm>
#include <limits>

namespace delam {

namespace {

constexpr ReferencePoint simplex_corner[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
constexpr ReferencePoint square_corner[] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
constexpr ReferencePoint cube_corner[] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                          {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};

// Gauss points of order 3 per direction sit at +-1/sqrt(3): the corners, drawn in.
constexpr double gauss = 0.57735026918962576451;
constexpr ReferencePoint square_gauss[] = {
    {-gauss, -gauss, 0}, {gauss, -gauss, 0}, {gauss, gauss, 0}, {-gauss, gauss, 0}};
constexpr ReferencePoint cube_gauss[] = {{-gauss, -gauss, -gauss}, {gauss, -gauss, -gauss}, {gauss, gauss, -gauss},
                                         {-gauss, gauss, -gauss},  {-gauss, -gauss, gauss}, {gauss, -gauss, gauss},
                                         {gauss, gauss, gauss},    {-gauss, gauss, gauss}};

constexpr ReferencePoint triangle_centre[] = {{1.0 / 3.0, 1.0 / 3.0, 0}};
constexpr ReferencePoint tetrahedron_centre[] = {{0.25, 0.25, 0.25}};
constexpr ReferencePoint cube_centre[] = {{0, 0, 0}};

using Matrix3 = std::array<double, 9>;  // row-major, the leading dimension x dimension block in use, stride 3

// dx_i/dxi_j = sum_a x_ai dN_a/dxi_j
Matrix3 tangent(int dimension, int nodes, std::span<const double> coordinates, const ShapeGradient& gradient) {
    Matrix3 j{};
    const auto dim = static_cast<std::size_t>(dimension);
    for (std::size_t a = 0; a < static_cast<std::size_t>(nodes); ++a)
        for (std::size_t r = 0; r < dim; ++r)
            for (std::size_t c = 0; c < dim; ++c) j[3 * r + c] += coordinates[a * dim + r] * gradient[a * dim + c];
    return j;
}

double determinant(int dimension, const Matrix3& j) {
    if (dimension == 2) return j[0] * j[4] - j[1] * j[3];
    return j[0] * (j[4] * j[8] - j[5] * j[7]) - j[1] * (j[3] * j[8] - j[5] * j[6]) + j[2] * (j[3] * j[7] - j[4] * j[6]);
}

Matrix3 inverse(int dimension, const Matrix3& j, double det) {
    if (dimension == 2) return {j[4] / det, -j[1] / det, 0, -j[3] / det, j[0] / det, 0, 0, 0, 0};
    return {(j[4] * j[8] - j[5] * j[7]) / det, (j[2] * j[7] - j[1] * j[8]) / det, (j[1] * j[5] - j[2] * j[4]) / det,
            (j[5] * j[6] - j[3] * j[8]) / det, (j[0] * j[8] - j[2] * j[6]) / det, (j[2] * j[3] - j[0] * j[5]) / det,
            (j[3] * j[7] - j[4] * j[6]) / det, (j[1] * j[6] - j[0] * j[7]) / det, (j[0] * j[4] - j[1] * j[3]) / det};
}

// Coordinates are taken relative to the first node: the sums above then do not cancel for a cell far from the origin.
std::array<double, 24> local_coordinates(int dimension, std::span<const double> coordinates) {
    std::array<double, 24> local{};
    const auto dim = static_cast<std::size_t>(dimension);
    for (std::size_t i = 0; i < coordinates.size(); ++i) local[i] = coordinates[i] - coordinates[i % dim];
    return local;
}

}  // namespace

Quadrature quadrature(CellType type) {
    switch (type) {
        case CellType::tri3: return {triangle_centre, 0.5};
        case CellType::quad4: return {square_gauss, 1.0};
        case CellType::tet4: return {tetrahedron_centre, 1.0 / 6.0};
        case CellType::hex8: break;
    }
    return {cube_gauss, 1.0};
}

std::span<const ReferencePoint> corners(CellType type) {
    switch (type) {
        case CellType::tri3: return std::span(simplex_corner).first(3);
        case CellType::quad4: return square_corner;
        case CellType::tet4: return simplex_corner;
        case CellType::hex8: break;
    }
    return cube_corner;
}

const ReferencePoint& centre(CellType type) {
    switch (type) {
        case CellType::tri3: return triangle_centre[0];
        case CellType::tet4: return tetrahedron_centre[0];
        case CellType::quad4:
        case CellType::hex8: break;
    }
    return cube_centre[0];
}

ShapeGradient reference_gradient(CellType type, const ReferencePoint& at) {
    const auto& [x, y, z] = at;
    ShapeGradient g{};
    switch (type) {
        case CellType::tri3: return {-1, -1, 1, 0, 0, 1};
        case CellType::tet4: return {-1, -1, -1, 1, 0, 0, 0, 1, 0, 0, 0, 1};
        case CellType::quad4:
            for (std::size_t a = 0; a < 4; ++a) {
                const auto& [u, v, w] = square_corner[a];
                g[2 * a] = 0.25 * u * (1.0 + v * y);
                g[2 * a + 1] = 0.25 * (1.0 + u * x) * v;
            }
            break;
        case CellType::hex8:
            for (std::size_t a = 0; a < 8; ++a) {
                const auto& [u, v, w] = cube_corner[a];
                g[3 * a] = 0.125 * u * (1.0 + v * y) * (1.0 + w * z);
                g[3 * a + 1] = 0.125 * (1.0 + u * x) * v * (1.0 + w * z);
                g[3 * a + 2] = 0.125 * (1.0 + u * x) * (1.0 + v * y) * w;
            }
            break;
    }
    return g;
}

PhysicalGradient physical_gradient(CellType type, std::span<const double> coordinates, const ReferencePoint& at) {
    const CellTopology& cell = topology(type);
    const auto dim = static_cast<std::size_t>(cell.dimension);
    const ShapeGradient reference = reference_gradient(type, at);
    const Matrix3 j = tangent(cell.dimension, cell.nodes, local_coordinates(cell.dimension, coordinates), reference);
    PhysicalGradient result{{}, determinant(cell.dimension, j)};
    const Matrix3 inv = inverse(cell.dimension, j, result.jacobian);
    for (std::size_t a = 0; a < static_cast<std::size_t>(cell.nodes); ++a)
        for (std::size_t c = 0; c < dim; ++c)
            for (std::size_t r = 0; r < dim; ++r)
                result.gradient[a * dim + c] += reference[a * dim + r] * inv[3 * r + c];
    return result;
}

double smallest_jacobian(CellType type, std::span<const double> coordinates) {
    const CellTopology& cell = topology(type);
    const std::array<double, 24> local = local_coordinates(cell.dimension, coordinates);
    double smallest = std::numeric_limits<double>::infinity();
    const auto visit = [&](std::span<const ReferencePoint> points) {
        for (const ReferencePoint& p : points) {
            const ShapeGradient gradient = reference_gradient(type, p);
            smallest =
                std::min(smallest, determinant(cell.dimension, tangent(cell.dimension, cell.nodes, local, gradient)));
        }
    };
    visit(quadrature(type).points);
    if (type == CellType::quad4 || type == CellType::hex8) visit(corners(type));
    return smallest;
}

}  // namespace delam
