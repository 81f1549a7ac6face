// SPDX-License-Identifier: BSD-3-Clause
// Convergence of every solid cell type on distorted meshes: the energy of an exact solution of elasticity.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "all_types.hpp"
#include "body/assembly.hpp"
#include "check.hpp"
#include "linalg/sparse/cholesky.hpp"
#include "mesh/faces.hpp"
#include "mesh/layers.hpp"
#include "mesh/shape.hpp"

using namespace delam;

namespace {

const Elastic steel{210.0, 0.3};
constexpr std::array<double, 3> block{1.3, 0.9, 0.7};

// u = grad(phi) with the harmonic phi = e^x sin(0.6 y) sin(0.8 z): no dilatation, and no body force.
std::array<double, 3> exact(std::span<const double> x) {
    const double e = std::exp(x[0]), s = std::sin(0.6 * x[1]), c = std::cos(0.6 * x[1]), t = std::sin(0.8 * x[2]),
                 d = std::cos(0.8 * x[2]);
    return {e * s * t, 0.6 * e * c * t, 0.8 * e * s * d};
}

// mu eps : eps = mu (grad grad phi)^2.
double density(const std::array<double, 3>& x) {
    const double e = std::exp(x[0]), s = std::sin(0.6 * x[1]), c = std::cos(0.6 * x[1]), t = std::sin(0.8 * x[2]),
                 d = std::cos(0.8 * x[2]);
    const double diagonal = (1.0 + 0.36 * 0.36 + 0.64 * 0.64) * std::pow(e * s * t, 2);
    const double beside = std::pow(0.6 * e * c * t, 2) + std::pow(0.8 * e * s * d, 2) + std::pow(0.48 * e * c * d, 2);
    return steel.young / (2.0 * (1.0 + steel.poisson)) * (diagonal + 2.0 * beside);
}

// By 8 x 8 x 8 boxes of 27 Gauss points.
double exact_energy() {
    const Quadrature& gauss = quadrature(CellType::hex20);
    double sum = 0.0;
    constexpr int n = 8;
    for (int box = 0; box < n * n * n; ++box) {
        const std::array<int, 3> place{box % n, box / n % n, box / n / n};
        for (std::size_t q = 0; q < gauss.points.size(); ++q) {
            std::array<double, 3> x;
            for (std::size_t i = 0; i < 3; ++i) x[i] = block[i] / n * (place[i] + 0.5 * (1.0 + gauss.points[q][i]));
            sum += gauss.weights[q] * block[0] * block[1] * block[2] / (8.0 * n * n * n) * density(x);
        }
    }
    return sum;
}

// The nodes inside the block move, the more the farther they are from its faces.
Mesh distorted(CellType type, std::int64_t divisions) {
    const std::int64_t n[] = {divisions, divisions};
    const double thickness[] = {block[2]};
    const Mesh plain = make_layers(3, std::span(block).first(2), n, thickness, std::span(n).first(1), type);
    std::vector<double> nodes(plain.nodes().begin(), plain.nodes().end());
    for (std::size_t k = 0; k < nodes.size(); k += 3) {
        double bump = 1.0;
        for (std::size_t i = 0; i < 3; ++i) bump *= std::sin(M_PI * nodes[k + i] / block[i]);
        for (std::size_t i = 0; i < 3; ++i) nodes[k + i] += (i == 1 ? -0.08 : 0.08) * block[i] * bump;
    }
    Mesh mesh(3, nodes);
    std::vector<std::int64_t> cells;
    for (std::int64_t c = 0; c < plain.cell_count(); ++c)
        cells.insert(cells.end(), plain.cell(c).begin(), plain.cell(c).end());
    mesh.add_cells(type, cells, {});
    return mesh;
}

// The energy where the exact displacement is prescribed on the boundary.
double energy(CellType type, std::int64_t divisions) {
    const Mesh mesh = distorted(type, divisions);
    const SparseMatrix k = assemble_stiffness(mesh, mesh.body_cells(0), mesh.body_nodes(0),
                                              BodyModel{steel, Plane::strain, Formulation::standard});
    const auto size = static_cast<std::size_t>(k.rows);
    std::vector<char> held(size, 0);
    for (const BoundaryFace& face : boundary_faces(mesh, 0))
        for (const std::int64_t node : face.all())
            for (std::size_t i = 0; i < 3; ++i) held[3 * index(node) + i] = 1;
    std::vector<double> u(size, 0.0), force(size);
    std::vector<std::int64_t> place(size, -1);
    std::int64_t free = 0;
    for (std::size_t r = 0; r < size; ++r)
        if (held[r] == 0)
            place[r] = free++;
        else
            u[r] = exact(mesh.node(static_cast<std::int64_t>(r / 3)))[r % 3];
    multiply(k, u, force);
    std::vector<Triplet> entries;
    std::vector<double> right(index(free)), x(index(free));
    for (std::size_t r = 0; r < size; ++r) {
        if (place[r] < 0) continue;
        right[index(place[r])] = -force[r];
        for (auto e = index(k.start[r]); e < index(k.start[r + 1]); ++e)
            if (const std::int64_t c = place[index(k.column[e])]; c >= 0) entries.push_back({place[r], c, k.value[e]});
    }
    const SparseMatrix inner = from_triplets(free, free, std::move(entries));
    SparseCholesky factor(inner);
    ck_assert(factor.factorise(inner));
    factor.solve(right, x);
    for (std::size_t r = 0; r < size; ++r)
        if (place[r] >= 0) u[r] = x[index(place[r])];
    multiply(k, u, force);
    double sum = 0.0;
    for (std::size_t r = 0; r < size; ++r) sum += 0.5 * u[r] * force[r];
    return sum;
}

// Linear cells have an error of the energy of h^2, quadratic ones of h^4.
LOOP_TEST(energy_converges, 0, std::size(all_types)) {
    const CellType type = all_types[index(loop)];
    const CellRow& row = cell_row(type);
    if (row.topology.dimension != 3) return;
    const double whole = exact_energy();
    const std::array<std::int64_t, 2> divisions =
        row.linear() ? std::array<std::int64_t, 2>{5, 10} : std::array<std::int64_t, 2>{3, 6};
    const double coarse = energy(type, divisions[0]) / whole - 1.0, fine = energy(type, divisions[1]) / whole - 1.0;
    const double order = std::log2(coarse / fine);
    std::printf("%s: errors of the energy %.2e and %.2e, order %.2f\n", row.topology.name, coarse, fine, order);
    ck_assert_msg(order > (row.linear() ? 1.85 : 3.7), "%s: order %.2f", row.topology.name, order);
    // The energy of the solution is a minimum.
    ck_assert(row.interpolation != Interpolation::linear || fine > 0.0);
}

}  // namespace
