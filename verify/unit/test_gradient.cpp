// SPDX-License-Identifier: BSD-3-Clause
// The operator of the gradient term against integrals known beforehand.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "gradients.hpp"
#include "mesh/pairing/interfaces.hpp"

using namespace delam;
using namespace unit;

TEST(lines) {
    for (const CellType type : plane_types) {
        const double length = 1.5;
        const Mesh mesh = two_layers(type, {length}, {3});
        const SparseMatrix a = stiffness_of(mesh);
        ck_laplacian(a);
        ck_near(quadratic_form(a, field(mesh, [](const Point& x) { return 2.0 - 3.0 * x[0]; })), 9.0 * length,
                1e-13 * 9.0, "linear");
        if (quadratic(type))
            ck_near(quadratic_form(a, field(mesh, [](const Point& x) { return x[0] * x[0]; })),
                    4.0 * std::pow(length, 3) / 3.0, 1e-13, "quadratic");
        // Element matrices 1/h [1 -1; -1 1] and 1/(3h) [7 1 -8; 1 7 -8; -8 -8 16] (ends, middle), h = 0.5, pairs along
        // x.
        const Numbers row = product(a, [&] {
            Numbers e(ones(mesh).size(), 0.0);
            e[0] = 1.0;
            return e;
        }());
        const Numbers exact = quadratic(type) ? Numbers{14.0 / 3.0, -16.0 / 3.0, 2.0 / 3.0} : Numbers{2.0, -2.0};
        for (std::size_t i = 0; i < row.size(); ++i)
            ck_near(row[i], i < exact.size() ? exact[i] : 0.0, 1e-13, "row of the first pair");
        // A rotated line gives the same.
        const SparseMatrix other = stiffness_of(two_layers(type, {length}, {3}, turned));
        ck_assert(other.column == a.column);
        for (std::size_t e = 0; e < a.value.size(); ++e) ck_near(other.value[e], a.value[e], 1e-12, "turned");
    }
}

TEST(faces) {
    for (const CellType type : solid_types) {
        const Mesh mesh = two_layers(type, {1.5, 0.8}, {3, 2});
        const double area = 1.2;
        const SparseMatrix a = stiffness_of(mesh);
        ck_laplacian(a);
        const auto linear = [](const Point& x) { return 1.0 + 2.0 * x[0] - 3.0 * x[1]; };
        ck_near(quadratic_form(a, field(mesh, linear)), 13.0 * area, 1e-12, "linear");
        // Patch test: inside, a linear field has no force.
        const Numbers force = product(a, field(mesh, linear)), x = field(mesh, [](const Point&p) { return p[0]; }),
                      across = field(mesh, [](const Point&p) { return p[1]; });
        for (std::size_t i = 0; i < force.size(); ++i)
            if (x[i] > 1e-9 && x[i] < 1.5 - 1e-9 && across[i] > 1e-9 && across[i] < 0.8 - 1e-9)
                ck_near(force[i], 0.0, 1e-12, "inside");
        if (quadratic(type))
            ck_near(quadratic_form(a, field(mesh, [](const Point& p) { return p[0] * p[1]; })),
                    1.5 * std::pow(0.8, 3) / 3.0 + 0.8 * std::pow(1.5, 3) / 3.0, 1e-12, "x y");
        // Rotated: the same. Sheared to the plane z = x/2 + y/3: the projection of the field's gradient onto that
        // plane.
        const auto wave = [](double u, double v) { return std::sin(2.0 * u) * std::exp(v); };
        const Mesh turned_mesh = two_layers(type, {1.5, 0.8}, {3, 2}, rotated);
        const auto original = [&](const Point& p) {  // by its distances, whatever the order of the pairs
            const auto node =
                std::find_if(interface_of(mesh).node_a.begin(), interface_of(mesh).node_a.end(), [&](std::int64_t n) {
                    const Point y = rotated({mesh.node(n)[0], mesh.node(n)[1], mesh.node(n)[2]});
                    return std::hypot(y[0] - p[0], y[1] - p[1], y[2] - p[2]) < 1e-9;
                });
            ck_assert(node != interface_of(mesh).node_a.end());
            return wave(mesh.node(*node)[0], mesh.node(*node)[1]);
        };
        const double straight = quadratic_form(a, field(mesh, [&](const Point& p) { return wave(p[0], p[1]); }));
        ck_near(quadratic_form(stiffness_of(turned_mesh), field(turned_mesh, original)), straight, 1e-12 * straight,
                "rotated");
        const Mesh tilted = two_layers(type, {1.5, 0.8}, {3, 2}, [](const Point& p) {
            return Point{p[0], p[1], p[2] + p[0] / 2.0 + p[1] / 3.0};
        });
        const Point c{2.0, -1.0, 0.5}, normal{-0.5, -1.0 / 3.0, 1.0};
        const double n2 = 0.25 + 1.0 / 9.0 + 1.0, along = c[0] * normal[0] + c[1] * normal[1] + c[2] * normal[2];
        ck_near(quadratic_form(stiffness_of(tilted),
                               field(tilted, [&](const Point& p) { return c[0] * p[0] + c[1] * p[1] + c[2] * p[2]; })),
                (5.25 - along * along / n2) * area * std::sqrt(n2), 1e-12, "tilted");
        // Cells moved within their plane.
        const Mesh distorted = two_layers(type, {1.5, 0.8}, {3, 2}, [](const Point& p) {
            return Point{p[0] + 0.15 * p[1] * p[0] * (1.5 - p[0]), p[1] + 0.2 * p[0] * p[1] * (0.8 - p[1]), p[2]};
        });
        const double size =
            quadratic_form(stiffness_of(distorted), field(distorted, [](const Point& p) { return p[0]; }));
        ck_near(size, area, type == CellType::tet10 || type == CellType::hex20 ? 2e-3 : 1e-12, "distorted: area");
    }
}

// Lengths and kappa scaled by powers of two: the same digits.
TEST(units_of_the_operator) {
    for (const CellType type : {CellType::quad4, CellType::quad8, CellType::hex8, CellType::tet10, CellType::hex20}) {
        const bool plane = topology(type).dimension == 2;
        const auto mesh = [&](double s) {
            return two_layers(type, plane ? Numbers{1.3} : Numbers{1.3, 0.9},
                              plane ? std::vector<std::int64_t>{5} : std::vector<std::int64_t>{3, 2},
                              [s](const Point& x) {
                                  return Point{s * x[0], s * x[1], s * x[2]};
                              });
        };
        const SparseMatrix a = stiffness_of(mesh(1.0)), b = stiffness_of(mesh(1024.0)), c = stiffness_of(mesh(1e3));
        for (std::size_t e = 0; e < a.value.size(); ++e) {
            ck_assert(b.value[e] * (plane ? 1024.0 : 1.0) == a.value[e]);
            ck_near(c.value[e] * (plane ? 1e3 : 1.0), a.value[e], 1e-11, "mm");
        }
    }
}

// A quarter of a circle and of a cylinder of radius 2, zeta = sin(phi): int cos^2(phi)/R^2 dA = pi/4 (times width) / R.
TEST(curved_faces) {
    constexpr double radius = 2.0;
    for (const CellType type :
         {CellType::quad8, CellType::tri6, CellType::hex20, CellType::tet10, CellType::quad4, CellType::hex8}) {
        const bool plane = topology(type).dimension == 2;
        const double exact = std::numbers::pi / 4.0 / radius * (plane ? 1.0 : 0.8);
        double error[3];
        for (int level = 0; level < 3; ++level) {
            const std::int64_t n = 4 << level;
            const Mesh mesh =
                two_layers(type, plane ? Numbers{1.0} : Numbers{1.0, 0.8},
                           plane ? std::vector<std::int64_t>{n} : std::vector<std::int64_t>{n, 2}, [&](const Point& x) {
                               const double phi = 0.5 * std::numbers::pi * x[0], r = radius + 0.5 - x[plane ? 1 : 2];
                               return plane ? Point{r * std::cos(phi), r * std::sin(phi), 0.0}
                                            : Point{r * std::cos(phi), x[1], r * std::sin(phi)};
                           });
            error[level] =
                std::abs(quadratic_form(stiffness_of(mesh),
                                        field(mesh, [&](const Point& x) { return x[plane ? 1 : 2] / radius; })) -
                         exact);
        }
        const double order = std::log2(error[1] / error[2]);
        std::printf("curved, type %d: errors %.1e %.1e %.1e, order %.2f\n", static_cast<int>(type), error[0], error[1],
                    error[2], order);
        ck_assert(order > (quadratic(type) ? 3.5 : 1.9));
    }
}

// Bricks and tetrahedra side by side: triangles among quadrilaterals repeat corners.
TEST(mixed_faces) {
    for (const bool second : {false, true}) {
        const Mesh bricks = two_layers(second ? CellType::hex20 : CellType::hex8, {1.0, 1.0}, {1, 1});
        const Mesh tetrahedra = two_layers(second ? CellType::tet10 : CellType::tet4, {1.0, 1.0}, {1, 1});
        Numbers nodes(bricks.nodes().begin(), bricks.nodes().end());
        for (std::size_t i = 0; i < tetrahedra.nodes().size(); ++i)
            nodes.push_back(tetrahedra.nodes()[i] + (i % 3 == 0 ? 5.0 : 0.0));
        Mesh mesh(3, nodes);
        for (std::int64_t c = 0; c < bricks.cell_count(); ++c)
            mesh.add_cells(bricks.cell_type(c), bricks.cell(c), std::vector<std::int32_t>{bricks.cell_body(c)});
        for (std::int64_t c = 0; c < tetrahedra.cell_count(); ++c) {
            std::vector<std::int64_t> cell(tetrahedra.cell(c).begin(), tetrahedra.cell(c).end());
            for (std::int64_t& n : cell) n += bricks.node_count();
            mesh.add_cells(tetrahedra.cell_type(c), cell, std::vector<std::int32_t>{tetrahedra.cell_body(c)});
        }
        add_interface(mesh, 0, 1, 0.0);
        const SparseMatrix a = stiffness_of(mesh);
        ck_laplacian(a);
        ck_near(quadratic_form(a, field(mesh, [](const Point& x) { return 2.0 * x[0] + x[1]; })), 10.0, 1e-12,
                "mixed, linear");
        const std::int64_t separate = stiffness_of(bricks).entries() + stiffness_of(tetrahedra).entries();
        ck_assert_int_eq(a.entries(), separate);
    }
}

TEST(notches_are_left_out) {
    const Mesh mesh = two_layers(CellType::quad4, {1.0}, {10});
    Numbers adhesion = ones(mesh);
    adhesion[0] = adhesion[1] = adhesion[2] = 0.0;
    adhesion[7] = 0.3;  // low initial adhesion is not a notch
    const GradientTerm term(3.0, surface_stiffness(mesh, interface_of(mesh), adhesion), interface_of(mesh).weight, 0);
    ck_assert_int_eq(term.coupled_pairs(), 8);
    for (std::size_t i = 0; i < 11; ++i) ck_assert(term.coupled(i) == (i >= 3));
    ck_near(term.diagonal(3), 3.0 * 10.0, 1e-12, "the tip has one face");
    ck_near(term.diagonal(7), 3.0 * 20.0, 1e-12, "inside");
    Numbers z(11, 1.0);
    z[0] = z[1] = z[2] = 0.0;
    ck_assert(term.energy(z) == 0.0);
}
