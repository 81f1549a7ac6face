// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/cell_jacobian.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "delam/delam.h"
#include "mesh/cell_shape.hpp"

namespace cli {

namespace {

// Barycentric L_0.. of a simplex; xi, eta in [-1, 1] of a quadrilateral.
using Local = std::array<double, 4>;
// d/dL_a or d/dxi, d/deta of one coordinate.
using Slope = std::array<double, 4>;

struct Rule {
    std::vector<Local> points;
    std::vector<double> weights;
};

// N_a = L_a; quadratic N_a = L_a (2 L_a - 1) at corners, N_ab = 4 L_a L_b between them.
Slope simplex_slope(const CellShape& shape, const double* x, std::size_t axis, const Local& at) {
    const auto dimension = static_cast<std::size_t>(shape.dimension);
    const std::size_t corners = shape.corners;
    const bool quadratic = !shape.linear();
    Slope slope{};
    for (std::size_t a = 0; a < corners; ++a)
        slope[a] = x[a * dimension + axis] * (quadratic ? 4.0 * at[a] - 1.0 : 1.0);
    if (!quadratic) return slope;
    for (std::size_t e = 0; e < shape.middles.size(); ++e) {
        const auto [a, b] = shape.middles[e];
        const double middle = 4.0 * x[(corners + e) * dimension + axis];
        slope[a] += middle * at[b];
        slope[b] += middle * at[a];
    }
    return slope;
}

// N_i = (1 + xi_i xi)(1 + eta_i eta)/4, of quad8 times (xi_i xi + eta_i eta - 1); midway (1 - xi^2)(1 + eta_i eta)/2
// and (1 + xi_i xi)(1 - eta^2)/2.
Slope quadrilateral_slope(const CellShape& shape, const double* x, std::size_t axis, const Local& at) {
    constexpr std::array<std::array<double, 2>, 8> node{
        {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}}};
    const double s = at[0];
    const double t = at[1];
    Slope slope{};
    for (std::size_t i = 0; i < shape.nodes; ++i) {
        const auto [p, q] = node[i];
        double ds = 0.25 * p * (1 + q * t);
        double dt = 0.25 * q * (1 + p * s);
        if (i < 4 && !shape.linear()) {
            ds *= 2 * p * s + q * t;
            dt *= p * s + 2 * q * t;
        } else if (p == 0) {
            ds = -s * (1 + q * t);
            dt = 0.5 * q * (1 - s * s);
        } else if (q == 0) {
            ds = 0.5 * p * (1 - t * t);
            dt = -t * (1 + p * s);
        }
        slope[0] += x[2 * i + axis] * ds;
        slope[1] += x[2 * i + axis] * dt;
    }
    return slope;
}

double jacobian(const CellShape& shape, const double* x, const Local& at) {
    const auto dimension = static_cast<std::size_t>(shape.dimension);
    std::array<std::array<double, 3>, 3> j{};
    for (std::size_t axis = 0; axis < dimension; ++axis) {
        const bool simplex = shape.simplex();
        const Slope slope = simplex ? simplex_slope(shape, x, axis, at) : quadrilateral_slope(shape, x, axis, at);
        for (std::size_t k = 0; k < dimension; ++k) j[axis][k] = simplex ? slope[k + 1] - slope[0] : slope[k];
    }
    if (dimension == 2) return j[0][0] * j[1][1] - j[0][1] * j[1][0];
    return j[0][0] * (j[1][1] * j[2][2] - j[1][2] * j[2][1]) - j[0][1] * (j[1][0] * j[2][2] - j[1][2] * j[2][0]) +
           j[0][2] * (j[1][0] * j[2][1] - j[1][1] * j[2][0]);
}

constexpr double h = 0.5;
constexpr double t = 1.0 / 3.0;

const std::vector<Local>& checked_points(const CellShape& shape) {
    static const std::vector<Local> triangle{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {h, h, 0, 0},
                                             {0, h, h, 0}, {h, 0, h, 0}, {t, t, t, 0}};
    static const std::vector<Local> tetrahedron{
        {1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}, {h, h, 0, 0},
        {0, h, h, 0}, {h, 0, h, 0}, {h, 0, 0, h}, {0, h, 0, h}, {0, 0, h, h},
        {t, t, t, 0}, {t, t, 0, t}, {t, 0, t, t}, {0, t, t, t}, {0.25, 0.25, 0.25, 0.25}};
    static const std::vector<Local> quadrilateral{{-1, -1}, {1, -1}, {1, 1},  {-1, 1}, {0, -1},
                                                  {1, 0},   {0, 1},  {-1, 0}, {0, 0}};
    if (!shape.simplex()) return quadrilateral;
    return shape.dimension == 2 ? triangle : tetrahedron;
}

// Exact: the Jacobian has degree 2 on tri6, 3 on tet10, 3 in each variable on quad8.
const Rule& measure_rule(const CellShape& shape) {
    static const double g = 1.0 / std::sqrt(3.0);
    static const Rule triangle{{{h, h, 0, 0}, {0, h, h, 0}, {h, 0, h, 0}}, {1.0 / 6, 1.0 / 6, 1.0 / 6}};
    static const Rule tetrahedron{
        {{1, 0, 0, 0},
         {0, 1, 0, 0},
         {0, 0, 1, 0},
         {0, 0, 0, 1},
         {t, t, t, 0},
         {t, t, 0, t},
         {t, 0, t, t},
         {0, t, t, t}},
        {1.0 / 240, 1.0 / 240, 1.0 / 240, 1.0 / 240, 9.0 / 240, 9.0 / 240, 9.0 / 240, 9.0 / 240}};
    static const Rule quadrilateral{{{-g, -g}, {g, -g}, {g, g}, {-g, g}}, {1, 1, 1, 1}};
    if (!shape.simplex()) return quadrilateral;
    return shape.dimension == 2 ? triangle : tetrahedron;
}

const CellShape& known(std::int32_t type) {
    for (const std::int32_t made : {DELAM_TRI3, DELAM_TRI6, DELAM_QUAD4, DELAM_QUAD8, DELAM_TET4, DELAM_TET10})
        if (type == made) return shape_of(type);
    throw std::logic_error("a cell type that generators do not make");
}

}  // namespace

double smallest_jacobian(std::int32_t type, const double* x) {
    const CellShape& shape = known(type);
    double smallest = HUGE_VAL;
    for (const Local& at : checked_points(shape)) smallest = std::min(smallest, jacobian(shape, x, at));
    return smallest;
}

double cell_measure(std::int32_t type, const double* x) {
    const CellShape& shape = known(type);
    const Rule& rule = measure_rule(shape);
    double sum = 0;
    for (std::size_t i = 0; i < rule.points.size(); ++i) sum += rule.weights[i] * jacobian(shape, x, rule.points[i]);
    return sum;
}

}  // namespace cli
