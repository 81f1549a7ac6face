// SPDX-License-Identifier: BSD-3-Clause
// Anisotropic elasticity against lamination theory, and against itself in other axes.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "body/assembly.hpp"
#include "body/cell_elasticity.hpp"
#include "body/material.hpp"
#include "body/orientation.hpp"
#include "check.hpp"
#include "linalg/dense/dense.hpp"
#include "mesh/layers.hpp"

using namespace delam;

namespace {

std::size_t size(std::int64_t i) { return static_cast<std::size_t>(i); }

// A ply, and a material with nine independent constants.
const Orthotropic ply{{135e9, 9e9, 9e9, 0.24, 0.24, 0.46, 5.2e9, 5.2e9, 9e9 / 2.92}};
const Orthotropic wood{{12e9, 0.9e9, 0.5e9, 0.4, 0.35, 0.6, 0.7e9, 0.6e9, 0.05e9}};
const Elastic matrix{3.4e9, 0.35};

Axes turned_about(int axis, double angle) {
    Axes a{};
    const auto k = size(axis), i = size((axis + 1) % 3), j = size((axis + 2) % 3);
    a[k * 3 + k] = 1.0;
    a[i * 3 + i] = a[j * 3 + j] = std::cos(angle);
    a[i * 3 + j] = std::sin(angle);
    a[j * 3 + i] = -std::sin(angle);
    return a;
}

Axes product(const Axes& a, const Axes& b) {
    Axes c{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t k = 0; k < 3; ++k) c[i * 3 + j] += a[i * 3 + k] * b[k * 3 + j];
    return c;
}

template <std::size_t n>
std::vector<double> inverse(std::span<const double, n * n> a) {
    DenseMatrix m(n, n);
    std::copy(a.begin(), a.end(), m.value.begin());
    const DenseMatrix inverse = inverse_definite(std::move(m));
    return {inverse.value.begin(), inverse.value.end()};
}

void close(double found, double expected, double scale) {
    ck_assert_msg(std::abs(found - expected) <= 1e-12 * scale, "%.17g, not %.17g", found, expected);
}

}  // namespace

TEST(compliance) {
    const SpaceElasticity d = space_elasticity(wood);
    const std::vector<double> s = inverse<6>(d);
    const auto& c = wood.constant;
    for (std::size_t i = 0; i < 3; ++i) close(s[i * 7] * c[i], 1.0, 1.0);
    close(-s[1] * c[0], c[3], 1.0);
    close(-s[2] * c[0], c[4], 1.0);
    close(-s[8] * c[1], c[5], 1.0);
    close(s[21] * c[6], 1.0, 1.0);
    close(s[28] * c[8], 1.0, 1.0);
    close(s[35] * c[7], 1.0, 1.0);

    // An isotropic material, described in both ways.
    const double g = matrix.young / (2.0 * (1.0 + matrix.poisson)), e = matrix.young, nu = matrix.poisson;
    const SpaceElasticity same = space_elasticity(Orthotropic{{e, e, e, nu, nu, nu, g, g, g}});
    const std::vector<double> expected = elasticity_matrix(matrix, 3, Plane::strain);
    for (std::size_t i = 0; i < 36; ++i) close(same[i], expected[i], 1e11);
    for (const Plane plane : {Plane::strain, Plane::stress}) {
        const auto flat = plane_elasticity(same, plane);
        const std::vector<double> plain = elasticity_matrix(matrix, 2, plane);
        for (std::size_t i = 0; i < 9; ++i) close(flat[i], plain[i], 1e11);
    }
}

// Tsai and Hahn: 1/E_x = c4/E1 + s4/E2 + (1/G12 - 2 nu12/E1) c2 s2, and Qbar_11, Qbar_16 of a ply in plane stress.
TEST(off_axis) {
    const auto& k = ply.constant;
    for (const double angle : {0.0, 0.3, 0.7, 1.2}) {
        const double c = std::cos(angle), s = std::sin(angle);
        const SpaceElasticity d = rotated(space_elasticity(ply), turned_about(2, angle));
        const std::vector<double> softness = inverse<6>(d);
        const double expected =
            std::pow(c, 4) / k[0] + std::pow(s, 4) / k[1] + (1.0 / k[6] - 2.0 * k[3] / k[0]) * c * c * s * s;
        close(softness[0] / expected, 1.0, 10.0);
        const auto q = plane_elasticity(d, Plane::stress);
        const double share = 1.0 - k[3] * k[3] * k[1] / k[0];
        const double q11 = k[0] / share, q22 = k[1] / share, q12 = k[3] * k[1] / share, q66 = k[6];
        close(q[0], q11 * std::pow(c, 4) + 2.0 * (q12 + 2.0 * q66) * c * c * s * s + q22 * std::pow(s, 4), q11);
        close(q[2], (q11 - q12 - 2.0 * q66) * c * c * c * s + (q12 - q22 + 2.0 * q66) * c * s * s * s, q11);
        close(q[8], (q11 + q22 - 2.0 * q12 - 2.0 * q66) * c * c * s * s + q66 * (std::pow(c, 4) + std::pow(s, 4)), q11);
    }
}

// Strains rotate with the axes: the energy of a strain is the same in both, and rotating back gives the first numbers.
TEST(turning) {
    const Axes axes = product(turned_about(0, 0.4), product(turned_about(1, -1.1), turned_about(2, 2.3)));
    Axes back{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) back[i * 3 + j] = axes[j * 3 + i];
    const SpaceElasticity d = space_elasticity(wood), turned = rotated(d, axes), again = rotated(turned, back);
    for (std::size_t i = 0; i < 36; ++i) {
        close(again[i], d[i], 1e11);
        ck_assert(turned[i] == turned[i % 6 * 6 + i / 6]);
    }
    const std::array<double, 6> strain{1e-3, -2e-3, 5e-4, 7e-4, -3e-4, 9e-4};
    const std::array<double, 6> in_space = rotated_strain(strain, axes);
    double energy = 0.0, same = 0.0;
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j) {
            energy += strain[i] * d[i * 6 + j] * strain[j];
            same += in_space[i] * turned[i * 6 + j] * in_space[j];
        }
    close(same, energy, energy);
    close(in_space[0] + in_space[1] + in_space[2], strain[0] + strain[1] + strain[2], 1e-3);
}

TEST(bounds) {
    const auto said = [](std::size_t i, double value) {
        Orthotropic m = ply;
        m.constant[i] = value;
        return indefinite_constant(m);
    };
    ck_assert(indefinite_constant(ply).empty() && indefinite_constant(wood).empty());
    ck_assert(said(Orthotropic::nu12, 3.8).find("nu12 = 3.8 is outside") == std::string::npos);
    ck_assert(said(Orthotropic::nu12, 3.9).find("nu12 = 3.9 is outside -3.87") == 0);
    ck_assert(said(Orthotropic::nu12, 3.9).find("nu21") != std::string::npos);
    ck_assert(said(Orthotropic::nu13, -3.9).find("nu13 = -3.9") == 0);
    ck_assert(said(Orthotropic::nu23, 1.0).find("nu23 = 1") == 0);
    // Each bound holds, but not all of them together.
    ck_assert(said(Orthotropic::nu23, 0.999).find("nu23 = 0.999 is outside") == 0);
    ck_assert(said(Orthotropic::g23, 0.0).find("G23 = 0") == 0);
    ck_assert(said(Orthotropic::e3, std::nan("")).find("E3") == 0);
    // The bound given in the message is the true one.
    const double c = ply.constant[3] * std::sqrt(ply.constant[1] / ply.constant[0]);
    const double most = 1.0 - 2.0 * c * c;
    ck_assert(said(Orthotropic::nu23, most * (1.0 + 1e-6)).find("nu23") == 0);
    ck_assert(said(Orthotropic::nu23, most * (1.0 - 1e-6)).empty());
}

TEST(orientation_list) {
    const std::int64_t three[] = {0, 1, 3}, one[] = {1};
    const Axes a = turned_about(2, 0.2), b = turned_about(2, 0.4), c = turned_about(1, 0.1);
    const Axes first[] = {a, b, a}, then[] = {c};
    const Orientation list = oriented({}, 5, three, first);
    ck_assert_uint_eq(list.axes.size(), 2);
    ck_assert((list.of_cell == std::vector<std::int32_t>{0, 1, -1, 0, -1}));
    const Orientation next = oriented(list, 5, one, then);
    ck_assert_uint_eq(next.axes.size(), 2);
    ck_assert(next.axes[1] == c && (next.of_cell == std::vector<std::int32_t>{0, 1, -1, 0, -1}));
    Axes made;
    const std::array<double, 3> x{2.0, 0.0, 0.0}, xy{-3.0, 4.0, 0.0}, none{};
    ck_assert(orthonormal_axes(x, xy, made) && (made == Axes{1, 0, 0, 0, 1, 0, 0, 0, 1}));
    ck_assert(!orthonormal_axes(x, x, made) && !orthonormal_axes(none, x, made));
}

// Rotating a body together with its material rotates its stiffness, and the energy of a linear field is that of the
// elasticity, out of the plane too.
TEST(cells_turn_with_the_body) {
    for (const CellType type : {CellType::quad4, CellType::hex8, CellType::tet10}) {
        const int dim = topology(type).dimension;
        const double lengths[] = {1.3, 0.9}, thickness[] = {0.7};
        const std::int64_t divisions[] = {2, 2}, layers[] = {2};
        const auto across = size(dim) - 1;
        const Mesh plain = make_layers(dim, std::span(lengths).first(across), std::span(divisions).first(across),
                                       thickness, layers, type);
        const Axes turn = dim == 2 ? turned_about(2, 0.6) : product(turned_about(0, 0.5), turned_about(2, 0.6));
        // x' = Q x with the columns of Q the rows of `turn`.
        std::vector<double> nodes(plain.nodes().size(), 0.0);
        const auto d = size(dim);
        for (std::size_t i = 0; i < nodes.size(); ++i)
            for (std::size_t j = 0; j < d; ++j) nodes[i] += turn[j * 3 + i % d] * plain.nodes()[i - i % d + j];
        Mesh mesh(dim, nodes);
        std::vector<std::int64_t> connectivity;
        for (std::int64_t c = 0; c < plain.cell_count(); ++c)
            connectivity.insert(connectivity.end(), plain.cell(c).begin(), plain.cell(c).end());
        mesh.add_cells(type, connectivity, {});

        const Axes own = turned_about(0, 0.3);  // the material's in the first body
        std::vector<std::int64_t> cells(size(plain.cell_count()));
        std::iota(cells.begin(), cells.end(), 0);
        const std::vector<Axes> before(cells.size(), own), after(cells.size(), product(own, turn));
        for (const Plane plane : {Plane::strain, Plane::stress}) {
            const auto model = [&](const std::vector<Axes>& axes) {
                return BodyModel{wood, plane, Formulation::standard,
                                 std::make_shared<const Orientation>(oriented({}, plain.cell_count(), cells, axes))};
            };
            const BodyModel old_model = model(before), new_model = model(after);
            std::vector<double> u(nodes.size()), turned(nodes.size(), 0.0), f(u.size()), g(u.size());
            for (std::size_t i = 0; i < u.size(); ++i) u[i] = 1e-3 * std::sin(1.0 + 7.0 * static_cast<double>(i));
            for (std::size_t i = 0; i < u.size(); ++i)
                for (std::size_t j = 0; j < d; ++j) turned[i] += turn[j * 3 + i % d] * u[i - i % d + j];
            multiply(assemble_stiffness(plain, plain.body_cells(0), plain.body_nodes(0), old_model), u, f);
            multiply(assemble_stiffness(mesh, mesh.body_cells(0), mesh.body_nodes(0), new_model), turned, g);
            for (std::size_t i = 0; i < f.size(); ++i) {
                double expected = 0.0;
                for (std::size_t j = 0; j < d; ++j) expected += turn[j * 3 + i % d] * f[i - i % d + j];
                ck_assert(std::abs(g[i] - expected) < 1e-11 * 12e9 * 1e-3);
            }
            // eps_xx = 1e-3 alone.
            std::fill(u.begin(), u.end(), 0.0);
            for (std::size_t n = 0; n < u.size(); n += d) u[n] = 1e-3 * plain.nodes()[n];
            const std::vector<double> stress = centre_stress(plain, std::span(&old_model, 1), u);
            const SpaceElasticity e = rotated(space_elasticity(wood), own);
            const auto flat = plane_elasticity(e, plane);
            const double in_space[] = {e[0], e[6], e[12], e[18], e[24], e[30]};
            const double in_plane[] = {flat[0], flat[3], plane == Plane::strain ? e[12] : 0.0, flat[6]};
            for (std::size_t k = 0; k < stress.size(); ++k)
                close(stress[k], 1e-3 * (d == 2 ? in_plane[k % 4] : in_space[k % 6]), 12e6 * 10.0);
        }
        // Isotropic bodies do not depend on their axes, to the last bit.
        const BodyModel round{matrix, Plane::strain, Formulation::standard,
                              std::make_shared<const Orientation>(oriented({}, plain.cell_count(), cells, before))};
        const BodyModel bare{matrix, Plane::strain, Formulation::standard, nullptr};
        ck_assert(assemble_stiffness(plain, cells, plain.body_nodes(0), round).value ==
                  assemble_stiffness(plain, cells, plain.body_nodes(0), bare).value);
    }
}
