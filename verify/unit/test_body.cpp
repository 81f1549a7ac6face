// SPDX-License-Identifier: BSD-3-Clause
// Stiffness, stresses and rigid motions against continuum formulas that need no finite elements.
#include <gsl/gsl_eigen.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <random>
#include <span>
#include <vector>

#include "all_types.hpp"
#include "base/error.hpp"
#include "body/assembly.hpp"
#include "body/element.hpp"
#include "body/material.hpp"
#include "body/rigid_modes.hpp"
#include "check.hpp"
#include "linalg/sparse/sparse.hpp"
#include "mesh/faces.hpp"
#include "mesh/layers.hpp"
#include "mesh/mesh.hpp"

using namespace delam;

namespace {

const Elastic steel{210e9, 0.3};
int dimension_of(CellType type) { return topology(type).dimension; }

// A block of one layer whose nodes are moved at random by up to a fifth of a cell, placed somewhere in space.
Mesh distorted_block(CellType type, double offset, double unit, std::int64_t divisions = 3) {
    const int dim = dimension_of(type);
    const std::array<double, 2> lengths{1.3, 0.9};
    const std::array<std::int64_t, 2> n{divisions, divisions - 1};
    const double thickness[] = {0.7};
    const std::int64_t layers[] = {divisions - 1};
    const auto across = static_cast<std::size_t>(dim) - 1;
    const Mesh plain =
        make_layers(dim, std::span(lengths).first(across), std::span(n).first(across), thickness, layers, type);
    std::mt19937 random(7);
    // Mid-side nodes move independently, so the cells are curved. They tolerate half as much.
    const double most = topology(type).nodes > topology(type).corners ? 0.025 : 0.06;
    std::uniform_real_distribution<double> shift(-most, most);
    std::vector<double> nodes(plain.nodes().begin(), plain.nodes().end());
    for (double& x : nodes) x = (x + shift(random) + offset) * unit;
    Mesh mesh(dim, nodes);
    std::vector<std::int64_t> connectivity;
    for (std::int64_t c = 0; c < plain.cell_count(); ++c)
        connectivity.insert(connectivity.end(), plain.cell(c).begin(), plain.cell(c).end());
    mesh.add_cells(type, connectivity, {});
    return mesh;
}

SparseMatrix whole_stiffness(const Mesh& mesh, Plane plane) {
    return assemble_stiffness(mesh, mesh.body_cells(0), mesh.body_nodes(0),
                              BodyModel{steel, plane, Formulation::standard});
}

std::vector<double> dense(const SparseMatrix& k) {
    const auto n = static_cast<std::size_t>(k.rows);
    std::vector<double> full(n * n, 0.0);
    for (std::size_t r = 0; r < n; ++r)
        for (auto e = static_cast<std::size_t>(k.start[r]); e < static_cast<std::size_t>(k.start[r + 1]); ++e)
            full[r * n + static_cast<std::size_t>(k.column[e])] = k.value[e];
    return full;
}

// Eigenvalues of a symmetric matrix, ascending.
std::vector<double> eigenvalues(std::vector<double> a, std::size_t n) {
    std::vector<double> values(n);
    gsl_matrix_view matrix = gsl_matrix_view_array(a.data(), n, n);
    gsl_vector_view list = gsl_vector_view_array(values.data(), n);
    gsl_eigen_symm_workspace* const work = gsl_eigen_symm_alloc(n);
    gsl_eigen_symm(&matrix.matrix, &list.vector, work);
    gsl_eigen_symm_free(work);
    std::sort(values.begin(), values.end());
    return values;
}

std::vector<double> element_matrix(CellType type, std::span<const double> x, std::span<const double> elasticity) {
    std::vector<double> k(x.size() * x.size());
    element_stiffness(type, x, elasticity, Formulation::standard, k);
    return k;
}

double norm(std::span<const double> x) { return std::sqrt(std::inner_product(x.begin(), x.end(), x.begin(), 0.0)); }

// Largest row sum of magnitudes.
double row_norm(const SparseMatrix& k) {
    double largest = 0.0;
    for (std::size_t r = 0; r < static_cast<std::size_t>(k.rows); ++r) {
        double sum = 0.0;
        for (auto e = static_cast<std::size_t>(k.start[r]); e < static_cast<std::size_t>(k.start[r + 1]); ++e)
            sum += std::abs(k.value[e]);
        largest = std::max(largest, sum);
    }
    return largest;
}

// int over the boundary of x . n / dim, face by face, with the shape functions of the face
// and enough Gauss points: x . (x_u cross x_v) has at most degree 6 in each variable, on an edge x cross x' has degree
// 3.
double curved_volume(const Mesh& mesh, std::int64_t c) {
    const CellTopology& cell = topology(mesh.cell_type(c));
    const double gauss[] = {-0.86113631159405257522, -0.33998104358485626480, 0.33998104358485626480,
                            0.86113631159405257522};
    const double share[] = {0.34785484513745385737, 0.65214515486254614263, 0.65214515486254614263,
                            0.34785484513745385737};
    double sum = 0.0;
    for (std::size_t f = 0; f < static_cast<std::size_t>(cell.faces); ++f) {
        const auto x = [&](int k, std::size_t i) {
            const auto local = static_cast<std::size_t>(cell.face[f].node[static_cast<std::size_t>(k)]);
            return mesh.node(mesh.cell(c)[local])[i] - mesh.node(mesh.cell(c)[0])[i];
        };
        for (std::size_t p = 0; p < 4; ++p) {
            if (cell.dimension == 2) {
                const double t = gauss[p];
                const double n[] = {0.5 * t * (t - 1.0), 0.5 * t * (t + 1.0), 1.0 - t * t};
                const double d[] = {t - 0.5, t + 0.5, -2.0 * t};
                double at[2] = {};
                double along[2] = {};
                for (int k = 0; k < 3; ++k)
                    for (std::size_t i = 0; i < 2; ++i) {
                        at[i] += n[k] * x(k, i);
                        along[i] += d[k] * x(k, i);
                    }
                sum += 0.5 * share[p] * (at[0] * along[1] - at[1] * along[0]);
                continue;
            }
            for (std::size_t q = 0; q < 4; ++q) {
                const bool triangle = cell.face[f].nodes == 6;
                // On the triangle, a collapsed square (Duffy): u = (1+p)/2, v = (1-u)(1+q)/2.
                const double u = triangle ? 0.5 * (1.0 + gauss[p]) : gauss[p];
                const double v = triangle ? (1.0 - u) * 0.5 * (1.0 + gauss[q]) : gauss[q];
                const double w = share[p] * share[q] * (triangle ? 0.25 * (1.0 - u) : 1.0);
                const CellType type = face_row(3, cell.face[f].nodes).surface;
                const ShapeValues n = shape_values(type, {u, v, 0.0});
                const ShapeGradient d = reference_gradient(type, {u, v, 0.0});
                double at[3] = {};
                double a[3] = {};
                double b[3] = {};
                for (int k = 0; k < static_cast<int>(cell.face[f].nodes); ++k)
                    for (std::size_t i = 0; i < 3; ++i) {
                        at[i] += n[static_cast<std::size_t>(k)] * x(k, i);
                        a[i] += d[static_cast<std::size_t>(2 * k)] * x(k, i);
                        b[i] += d[static_cast<std::size_t>(2 * k + 1)] * x(k, i);
                    }
                for (std::size_t i = 0; i < 3; ++i)
                    sum += w / 3.0 * at[i] * (a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]);
            }
        }
    }
    return sum;
}

// Computes the volume from the cells' boundaries alone.
double volume(const Mesh& mesh) {
    double sum = 0.0;
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c) {
        const auto cell = mesh.cell(c);
        if (topology(mesh.cell_type(c)).nodes > topology(mesh.cell_type(c)).corners) {
            sum += curved_volume(mesh, c);
            continue;
        }
        const auto x = [&](std::size_t i, std::size_t k) { return mesh.node(cell[i])[k] - mesh.node(cell[0])[k]; };
        if (mesh.dimension() == 2) {
            for (std::size_t i = 0; i < cell.size(); ++i) {
                const std::size_t j = (i + 1) % cell.size();
                sum += 0.5 * (x(i, 0) * x(j, 1) - x(j, 0) * x(i, 1));
            }
            continue;
        }
        // Signed cones from node 0 to the faces; a warped quadrilateral counts as the mean of its two triangulations.
        const CellTopology& shape = topology(mesh.cell_type(c));
        for (std::size_t f = 0; f < static_cast<std::size_t>(shape.faces); ++f) {
            const auto cone = [&](std::size_t i, std::size_t j, std::size_t k) {
                const auto a = static_cast<std::size_t>(shape.face[f].node[i]);
                const auto b = static_cast<std::size_t>(shape.face[f].node[j]);
                const auto d = static_cast<std::size_t>(shape.face[f].node[k]);
                return (x(a, 0) * (x(b, 1) * x(d, 2) - x(b, 2) * x(d, 1)) -
                        x(a, 1) * (x(b, 0) * x(d, 2) - x(b, 2) * x(d, 0)) +
                        x(a, 2) * (x(b, 0) * x(d, 1) - x(b, 1) * x(d, 0))) /
                       6.0;
            };
            if (shape.face[f].nodes == 3)
                sum += cone(0, 1, 2);
            else
                sum += 0.5 * (cone(0, 1, 2) + cone(0, 2, 3) + cone(0, 1, 3) + cone(1, 2, 3));
        }
    }
    return sum;
}

}  // namespace

// A linear displacement field u = A x: constant stress from Hooke's law in tensor form, no force on inner nodes, and
// energy = volume * sigma:eps/2.
TEST(patch_test) {
    const double gradient[3][3] = {{1.0e-3, 0.4e-3, -0.3e-3}, {-0.7e-3, 0.5e-3, 0.2e-3}, {0.6e-3, -0.1e-3, -0.8e-3}};
    for (const CellType type : all_types) {
        for (const Plane plane : {Plane::strain, Plane::stress}) {
            const Mesh mesh = distorted_block(type, 0.0, 1.0);
            const auto dim = static_cast<std::size_t>(mesh.dimension());
            std::vector<double> u;
            for (std::int64_t n = 0; n < mesh.node_count(); ++n)
                for (std::size_t i = 0; i < dim; ++i) {
                    double sum = 0.0;
                    for (std::size_t j = 0; j < dim; ++j) sum += gradient[i][j] * mesh.node(n)[j];
                    u.push_back(sum);
                }

            const double mu = steel.young / (2.0 * (1.0 + steel.poisson));
            const double lambda = steel.young * steel.poisson / ((1.0 + steel.poisson) * (1.0 - 2.0 * steel.poisson));
            double eps[3][3] = {};
            for (std::size_t i = 0; i < dim; ++i)
                for (std::size_t j = 0; j < dim; ++j) eps[i][j] = 0.5 * (gradient[i][j] + gradient[j][i]);
            // Plane stress: eps_zz makes sigma_zz vanish.
            if (dim == 2 && plane == Plane::stress) eps[2][2] = -lambda / (lambda + 2.0 * mu) * (eps[0][0] + eps[1][1]);
            double sigma[3][3];
            double density = 0.0;
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t j = 0; j < 3; ++j) {
                    sigma[i][j] = 2.0 * mu * eps[i][j] + (i == j ? lambda * (eps[0][0] + eps[1][1] + eps[2][2]) : 0.0);
                    density += 0.5 * sigma[i][j] * eps[i][j];
                }
            const std::vector<double> expected =
                dim == 2 ? std::vector{sigma[0][0], sigma[1][1], sigma[2][2], sigma[0][1]}
                         : std::vector{sigma[0][0], sigma[1][1], sigma[2][2], sigma[0][1], sigma[1][2], sigma[2][0]};

            const BodyModel models[] = {{steel, plane, Formulation::standard}};
            const std::vector<double> stress = centre_stress(mesh, models, u);
            ck_assert_uint_eq(stress.size(), expected.size() * static_cast<std::size_t>(mesh.cell_count()));
            for (std::size_t s = 0; s < stress.size(); ++s)
                ck_assert(std::abs(stress[s] - expected[s % expected.size()]) <= 1e-11 * steel.young * 1e-3);

            const SparseMatrix k = whole_stiffness(mesh, plane);
            std::vector<double> force(u.size());
            multiply(k, u, force);
            std::vector<char> outer(u.size(), 0);
            for (const BoundaryFace& face : boundary_faces(mesh, 0))
                for (std::size_t i = 0; i < static_cast<std::size_t>(face.nodes); ++i)
                    for (std::size_t d = 0; d < dim; ++d) outer[static_cast<std::size_t>(face.node[i]) * dim + d] = 1;
            ck_assert(std::find(outer.begin(), outer.end(), 0) != outer.end());
            for (std::size_t i = 0; i < u.size(); ++i)
                if (outer[i] == 0) ck_assert(std::abs(force[i]) <= 1e-13 * row_norm(k) * 2e-3);
            const double energy = 0.5 * std::inner_product(u.begin(), u.end(), force.begin(), 0.0);
            ck_assert(std::abs(energy - density * volume(mesh)) <= 1e-11 * energy);
        }
    }
}

// u_x = x y (z): not a linear field, but these elements represent it on a box; its energy is computed by hand.
TEST(energy_of_a_product_field) {
    const double a = 1.7;
    const double b = 0.6;
    const double c = 2.3;
    const double rectangle[] = {0, 0, a, 0, a, b, 0, b};
    for (const Plane plane : {Plane::strain, Plane::stress}) {
        const std::vector<double> d = elasticity_matrix(steel, 2, plane);
        const std::vector<double> k = element_matrix(CellType::quad4, rectangle, d);
        const double u = a * b;  // of node 2, x component: DOF 4
        const double exact = 0.5 * (d[0] * a * b * b * b / 3.0 + d[8] * a * a * a * b / 3.0);
        ck_assert(std::abs(0.5 * u * u * k[4 * 8 + 4] - exact) <= 1e-14 * exact);
    }
    const double box[] = {0, 0, 0, a, 0, 0, a, b, 0, 0, b, 0, 0, 0, c, a, 0, c, a, b, c, 0, b, c};
    const std::vector<double> d = elasticity_matrix(steel, 3, Plane::strain);
    const std::vector<double> k = element_matrix(CellType::hex8, box, d);
    const double u = a * b * c;  // of node 6, x component: DOF 18
    const double exact =
        (d[0] * a * std::pow(b * c, 3) + d[21] * b * std::pow(a * c, 3) + d[21] * c * std::pow(a * b, 3)) / 18.0;
    ck_assert(std::abs(0.5 * u * u * k[18 * 24 + 18] - exact) <= 1e-14 * exact);
}

TEST(kernel_and_symmetry) {
    for (const CellType type : all_types) {
        const Mesh mesh = distorted_block(type, 0.0, 1.0);
        const SparseMatrix k = whole_stiffness(mesh, Plane::strain);
        const auto n = static_cast<std::size_t>(k.rows);
        const std::vector<double> full = dense(k);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < i; ++j) ck_assert(full[i * n + j] == full[j * n + i]);
        for (std::size_t r = 0; r < n; ++r)
            for (auto e = static_cast<std::size_t>(k.start[r]) + 1; e < static_cast<std::size_t>(k.start[r + 1]); ++e)
                ck_assert(k.column[e - 1] < k.column[e]);

        const std::size_t kernel = mesh.dimension() == 2 ? 3 : 6;
        const std::vector<double> values = eigenvalues(full, n);
        ck_assert(std::abs(values[0]) <= 1e-13 * values.back());
        ck_assert(std::abs(values[kernel - 1]) <= 1e-13 * values.back());
        ck_assert(values[kernel] >= 1e-5 * values.back());

        const std::vector<double> r = rigid_modes(mesh, mesh.body_nodes(0));
        ck_assert_uint_eq(r.size(), n * kernel);
        std::vector<double> product(n);
        for (std::size_t m = 0; m < kernel; ++m) {
            multiply(k, std::span(r).subspan(m * n, n), product);
            ck_assert(norm(product) <= 1e-14 * row_norm(k));
        }
    }
}

// A single cell has only rigid motions without energy: full quadrature has no hourglass modes.
TEST(single_cells) {
    for (const CellType type : all_types) {
        const Mesh mesh = distorted_block(type, 0.0, 1.0);
        const auto cell = mesh.cell(1);
        std::vector<double> x;
        for (const std::int64_t n : cell) x.insert(x.end(), mesh.node(n).begin(), mesh.node(n).end());
        const std::vector<double> k =
            element_matrix(type, x, elasticity_matrix(steel, mesh.dimension(), Plane::strain));
        const std::vector<double> values = eigenvalues(k, x.size());
        const std::size_t kernel = mesh.dimension() == 2 ? 3 : 6;
        ck_assert(std::abs(values[kernel - 1]) <= 1e-13 * values.back());
        ck_assert(values[kernel] >= 1e-3 * values.back());
    }
}

TEST(rigid_modes_are_orthonormal) {
    for (const CellType type : all_types) {
        for (const double offset : {0.0, 1e4}) {
            for (const double unit : {1.0, 0x1p-20, 0x1p+20}) {
                const Mesh mesh = distorted_block(type, offset, unit);
                const std::vector<std::int64_t> nodes = mesh.body_nodes(0);
                const std::vector<double> r = rigid_modes(mesh, nodes);
                const std::size_t n = nodes.size() * static_cast<std::size_t>(mesh.dimension());
                const std::size_t modes = mesh.dimension() == 2 ? 3 : 6;
                ck_assert_uint_eq(r.size(), n * modes);
                for (std::size_t i = 0; i < modes; ++i)
                    for (std::size_t j = 0; j < modes; ++j) {
                        const double product = std::inner_product(&r[i * n], &r[i * n] + n, &r[j * n], 0.0);
                        ck_assert(std::abs(product - (i == j ? 1.0 : 0.0)) <= 1e-14);
                    }
                // No stretch between any two nodes: (r_k - r_l) . (x_k - x_l) = 0.
                const auto dim = static_cast<std::size_t>(mesh.dimension());
                for (std::size_t m = 0; m < modes; ++m)
                    for (std::size_t k = 1; k < nodes.size(); ++k) {
                        double stretch = 0.0;
                        for (std::size_t i = 0; i < dim; ++i)
                            stretch += (r[m * n + k * dim + i] - r[m * n + i]) *
                                       (mesh.node(nodes[k])[i] - mesh.node(nodes[0])[i]);
                        ck_assert(std::abs(stretch) <= (offset > 0.0 ? 1e-11 : 1e-14) * mesh.size());
                    }
                if (offset == 0.0 && unit == 1.0) continue;
                if (offset == 0.0) ck_assert(r == rigid_modes(distorted_block(type, 0.0, 1.0), nodes));
            }
        }
    }
    // Few and badly placed nodes.
    const double line[] = {0, 0, 0, 1, 2, 3, 2, 4, 6, 1, 0, 0};
    const Mesh space(3, line);
    const std::int64_t two[] = {0, 1};
    const std::int64_t collinear[] = {0, 1, 2};
    const std::int64_t plane[] = {0, 1, 3};
    ck_assert_uint_eq(rigid_modes(space, two).size(), 6 * 5);
    ck_assert_uint_eq(rigid_modes(space, collinear).size(), 9 * 5);
    ck_assert_uint_eq(rigid_modes(space, plane).size(), 9 * 6);
    const Mesh flat(2, std::span(line).first(8));
    ck_assert_uint_eq(rigid_modes(flat, two).size(), 4 * 3);
}

// With more cells than a batch and threads that share it, no bit changes.
TEST(assembly_by_threads) {
    for (const CellType type : all_types) {
        const int dim = dimension_of(type);
        const std::array<double, 2> lengths{1.3, 0.9};
        const std::array<std::int64_t, 2> n{dim == 2 ? 30 : 9, 9};
        const double thickness[] = {0.7};
        const std::int64_t layers[] = {dim == 2 ? 20 : 8};
        const auto across = static_cast<std::size_t>(dim) - 1;
        const Mesh mesh =
            make_layers(dim, std::span(lengths).first(across), std::span(n).first(across), thickness, layers, type);
        ck_assert_int_gt(mesh.cell_count(), 512);
        for (const Formulation formulation :
             {Formulation::standard, Formulation::incompatible, Formulation::mean_dilatation}) {
            if (formulation == Formulation::incompatible && type != CellType::quad4 && type != CellType::hex8) continue;
            const BodyModel model{steel, Plane::strain, formulation};
            const auto with = [&](const Mesh& body, std::int64_t threads) {
                return assemble_stiffness(body, body.body_cells(0), body.body_nodes(0), model, threads);
            };
            const SparseMatrix one = with(mesh, 1);
            for (const std::int64_t threads : {2, 5}) {
                const SparseMatrix more = with(mesh, threads);
                ck_assert(more.start == one.start && more.column == one.column && more.value == one.value);
            }
        }
    }
}

// The stiffnesses of parts of a body sum to that of the body.
TEST(assembly_of_parts) {
    for (const CellType type : all_types) {
        const Mesh mesh = distorted_block(type, 0.0, 1.0);
        const SparseMatrix whole = whole_stiffness(mesh, Plane::strain);
        const auto n = static_cast<std::size_t>(whole.rows);
        const auto dim = static_cast<std::size_t>(mesh.dimension());
        std::vector<double> sum(n * n, 0.0);
        for (std::int64_t parity = 0; parity < 2; ++parity) {
            std::vector<std::int64_t> cells;
            std::vector<std::int64_t> nodes;
            for (std::int64_t c = parity; c < mesh.cell_count(); c += 2) {
                cells.push_back(c);
                nodes.insert(nodes.end(), mesh.cell(c).begin(), mesh.cell(c).end());
            }
            std::sort(nodes.begin(), nodes.end());
            nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
            const SparseMatrix part =
                assemble_stiffness(mesh, cells, nodes, BodyModel{steel, Plane::strain, Formulation::standard});
            const std::vector<double> full = dense(part);
            const std::size_t m = nodes.size() * dim;
            for (std::size_t i = 0; i < m; ++i)
                for (std::size_t j = 0; j < m; ++j)
                    sum[(static_cast<std::size_t>(nodes[i / dim]) * dim + i % dim) * n +
                        static_cast<std::size_t>(nodes[j / dim]) * dim + j % dim] += full[i * m + j];
        }
        const std::vector<double> full = dense(whole);
        const double size = row_norm(whole);
        for (std::size_t e = 0; e < n * n; ++e) ck_assert(std::abs(sum[e] - full[e]) <= 1e-14 * size);
    }
}

TEST(jacobian_sign) {
    const double square[] = {0, 0, 1, 0, 1, 1, 0, 1};
    ck_assert(std::abs(smallest_jacobian(CellType::quad4, square) - 0.25) <= 1e-15);
    const double bow_tie[] = {0, 0, 1, 0, 0, 1, 1, 1};
    ck_assert(smallest_jacobian(CellType::quad4, bow_tie) < 0.0);
    const double reflex[] = {0, 0, 1, 0, 0.2, 0.2, 0, 1};  // fine at the Gauss points, not at the corner
    ck_assert(smallest_jacobian(CellType::quad4, reflex) < 0.0);
    const double clockwise[] = {0, 0, 0, 1, 1, 0};
    ck_assert(std::abs(smallest_jacobian(CellType::tri3, clockwise) + 1.0) <= 1e-15);
    const double corner[] = {5, 5, 5, 6, 5, 5, 5, 6, 5, 5, 5, 6};
    ck_assert(std::abs(smallest_jacobian(CellType::tet4, corner) - 1.0) <= 1e-14);
}

TEST(triplets) {
    std::mt19937 random(3);
    std::uniform_int_distribution<std::int64_t> row(0, 12);
    std::uniform_int_distribution<std::int64_t> column(0, 8);
    std::uniform_real_distribution<double> value(-1.0, 1.0);
    std::vector<Triplet> list;
    std::vector<double> full(13 * 9, 0.0);
    for (int i = 0; i < 400; ++i) {
        const Triplet t{row(random), column(random) / 2 * 2, value(random)};  // odd columns stay empty
        full[static_cast<std::size_t>(t.row * 9 + t.column)] += t.value;
        list.push_back(t);
    }
    const SparseMatrix m = from_triplets(13, 9, list);
    ck_assert_int_eq(m.rows, 13);
    ck_assert_int_eq(m.columns, 9);
    ck_assert_uint_eq(m.start.size(), 14);
    std::vector<double> again(13 * 9, 0.0);
    for (std::size_t r = 0; r < 13; ++r)
        for (auto e = static_cast<std::size_t>(m.start[r]); e < static_cast<std::size_t>(m.start[r + 1]); ++e) {
            if (e > static_cast<std::size_t>(m.start[r])) ck_assert(m.column[e - 1] < m.column[e]);
            again[r * 9 + static_cast<std::size_t>(m.column[e])] += m.value[e];
        }
    ck_assert(again == full);  // bit for bit: sums run in the order given
    std::vector<double> x(9);
    std::iota(x.begin(), x.end(), 1.0);
    std::vector<double> y(13);
    multiply(m, x, y);
    for (std::size_t r = 0; r < 13; ++r)
        ck_assert(std::abs(y[r] - std::inner_product(x.begin(), x.end(), &full[r * 9], 0.0)) <= 1e-12);
    const SparseMatrix none = from_triplets(0, 0, {});
    ck_assert_int_eq(none.entries(), 0);
    bool refused = false;
    try {
        from_triplets(2, 2, {{0, 2, 1.0}});
    } catch (const Error&) {
        refused = true;
    }
    ck_assert(refused);
}

TEST(bad_materials) {
    for (const Elastic bad : {Elastic{0.0, 0.3}, Elastic{-1.0, 0.3}, Elastic{1.0, 0.5}, Elastic{1.0, -1.0},
                              Elastic{std::nan(""), 0.3}, Elastic{1.0, std::nan("")}}) {
        bool refused = false;
        try {
            elasticity_matrix(bad, 3, Plane::strain);
        } catch (const Error&) {
            refused = true;
        }
        ck_assert(refused);
    }
}
