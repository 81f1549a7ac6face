// SPDX-License-Identifier: BSD-3-Clause
// Meshes of two layers and their gradient terms.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "check.hpp"
#include "evolution/increment/gradient.hpp"
#include "mesh/layers.hpp"
#include "mesh/pairing/interfaces.hpp"
#include "mesh/rule/mid_sides.hpp"

namespace unit {

using namespace delam;

using Numbers = std::vector<double>;
using Point = std::array<double, 3>;
using Map = std::function<Point(const Point&)>;

constexpr CellType plane_types[] = {CellType::quad4, CellType::tri3, CellType::quad8, CellType::quad9, CellType::tri6};
constexpr CellType solid_types[] = {CellType::hex8,  CellType::tet4,   CellType::hex20,    CellType::tet10,
                                    CellType::hex27, CellType::wedge6, CellType::pyramid5, CellType::wedge15};
inline bool quadratic(CellType type) { return topology(type).nodes > topology(type).corners; }

// Two layers of thickness 0.5, their nodes moved by `map`.
inline Mesh two_layers(CellType type, const Numbers& lengths, const std::vector<std::int64_t>& divisions,
                       const Map& map = {}) {
    const Numbers thickness{0.5, 0.5};
    const std::vector<std::int64_t> through{1, 1};
    const Mesh straight = make_layers(topology(type).dimension, lengths, divisions, thickness, through, type);
    Numbers nodes(straight.nodes().begin(), straight.nodes().end());
    const auto dim = static_cast<std::size_t>(straight.dimension());
    for (std::size_t i = 0; map && i < nodes.size(); i += dim) {
        Point x{};
        std::copy_n(nodes.begin() + static_cast<std::ptrdiff_t>(i), dim, x.begin());
        const Point y = map(x);
        std::copy_n(y.begin(), dim, nodes.begin() + static_cast<std::ptrdiff_t>(i));
    }
    Mesh mesh(straight.dimension(), nodes);
    for (std::int64_t c = 0; c < straight.cell_count(); ++c)
        mesh.add_cells(type, straight.cell(c), std::vector<std::int32_t>{straight.cell_body(c)});
    add_interface(mesh, 0, 1, 0.0);
    return mesh;
}

inline const InterfaceGeometry& interface_of(const Mesh& mesh) { return mesh.interfaces()[0]; }
inline Numbers ones(const Mesh& mesh) { return Numbers(interface_of(mesh).weight.size(), 1.0); }
inline SparseMatrix stiffness_of(const Mesh& mesh) { return surface_stiffness(mesh, interface_of(mesh), ones(mesh)); }

inline Numbers field(const Mesh& mesh, const std::function<double(const Point&)>& f) {
    Numbers z;
    for (const std::int64_t of_pair : interface_of(mesh).node_a) {
        const std::int64_t node = node_of_pair(mesh, of_pair);
        Point x{};
        std::copy(mesh.node(node).begin(), mesh.node(node).end(), x.begin());
        z.push_back(f(x));
    }
    return z;
}

inline Numbers product(const SparseMatrix& a, const Numbers& z) {
    Numbers y(z.size());
    multiply(a, z, y);
    return y;
}
inline double quadratic_form(const SparseMatrix& a, const Numbers& z) {
    const Numbers y = product(a, z);
    double sum = 0.0;
    for (std::size_t i = 0; i < z.size(); ++i) sum += z[i] * y[i];
    return sum;
}

inline void ck_near(double value, double exact, double tolerance, const char* what) {
    ck_assert_msg(std::abs(value - exact) <= tolerance, "%s: %.17g instead of %.17g, off by %.2e, allowed %.2e", what,
                  value, exact, std::abs(value - exact), tolerance);
}

// Symmetric, rows sum to zero, positive for everything that is not constant.
inline void ck_laplacian(const SparseMatrix& a) {
    double largest = 0.0;
    for (const double v : a.value) largest = std::max(largest, std::abs(v));
    const SparseMatrix t = transpose(a);
    ck_assert(t.column == a.column && t.value == a.value);
    for (const double row : product(a, Numbers(static_cast<std::size_t>(a.rows), 1.0)))
        ck_near(row, 0.0, 1e-13 * largest, "row sum");
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    Numbers z(static_cast<std::size_t>(a.rows));
    for (int k = 0; k < 20; ++k) {
        for (double& v : z) v = unit(random);
        ck_assert(quadratic_form(a, z) > 0.0);
    }
}

inline Point rotated(const Point& x) {
    const double c = std::cos(0.7), s = std::sin(0.7), d = std::cos(-1.1), e = std::sin(-1.1);
    const Point y{c * x[0] - s * x[2], x[1], s * x[0] + c * x[2]};
    return {d * y[0] - e * y[1] + 3.0, e * y[0] + d * y[1] - 2.0, y[2] + 5.0};
}
inline Point turned(const Point& x) { return {0.6 * x[0] - 0.8 * x[1] + 3.0, 0.8 * x[0] + 0.6 * x[1], 0.0}; }

}  // namespace unit
