// SPDX-License-Identifier: BSD-3-Clause
// Cells with a projected dilatation: the patch test on distorted cells, only rigid motions without energy, and
// symmetry.
#include <array>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "body/assembly.hpp"
#include "check.hpp"
#include "linalg/dense/dense.hpp"
#include "mesh/layers.hpp"
#include "refused.hpp"

using namespace delam;

namespace {

constexpr CellType projected_types[] = {CellType::quad4,  CellType::hex8,     CellType::tri6,   CellType::quad8,
                                        CellType::quad9,  CellType::tet10,    CellType::hex20,  CellType::hex27,
                                        CellType::wedge6, CellType::pyramid5, CellType::wedge15};
const Elastic rubber{1.0, 0.4999};
const Orthotropic ply{{20.0, 1.0, 1.5, 0.3, 0.2, 0.4, 0.5, 0.6, 0.35}};

std::size_t size(std::int64_t i) { return static_cast<std::size_t>(i); }

// Every node moved a little: distorted, and quadratic cells curved.
Mesh distorted(CellType type, std::int64_t divisions) {
    const int dim = topology(type).dimension;
    const double lengths[] = {1.0, 0.9}, thickness[] = {1.1};
    const std::int64_t n[] = {divisions, divisions}, layers[] = {divisions};
    const auto across = size(dim) - 1;
    const Mesh plain =
        make_layers(dim, std::span(lengths).first(across), std::span(n).first(across), thickness, layers, type);
    std::mt19937 random(3);
    const double most = (topology(type).nodes > topology(type).corners ? 0.04 : 0.12) / static_cast<double>(divisions);
    std::uniform_real_distribution<double> shift(-most, most);
    std::vector<double> nodes(plain.nodes().begin(), plain.nodes().end());
    for (double& x : nodes) x += shift(random);
    Mesh mesh(dim, nodes);
    std::vector<std::int64_t> cells;
    for (std::int64_t c = 0; c < plain.cell_count(); ++c)
        cells.insert(cells.end(), plain.cell(c).begin(), plain.cell(c).end());
    mesh.add_cells(type, cells, {});
    return mesh;
}

SparseMatrix stiffness(const Mesh& mesh, const BodyModel& model) {
    return assemble_stiffness(mesh, mesh.body_cells(0), mesh.body_nodes(0), model);
}

std::vector<Material> materials() { return {rubber, ply}; }

}  // namespace

// A linear displacement gives the forces and stresses of standard cells.
TEST(patch) {
    for (const CellType type : projected_types)
        for (const Material& material : materials()) {
            const Mesh mesh = distorted(type, 3);
            const auto dim = size(mesh.dimension());
            const BodyModel projected{material, Plane::strain, Formulation::mean_dilatation},
                plain{material, Plane::strain, Formulation::standard};
            std::vector<double> u;
            for (std::int64_t n = 0; n < mesh.node_count(); ++n)
                for (std::size_t i = 0; i < dim; ++i) {
                    double sum = 0.0;
                    for (std::size_t j = 0; j < dim; ++j)
                        sum += 1e-3 * static_cast<double>((3 * i + 5 * j) % 7 + 1) * mesh.node(n)[j];
                    u.push_back(sum);
                }
            std::vector<double> f(u.size()), g(u.size());
            multiply(stiffness(mesh, projected), u, f);
            multiply(stiffness(mesh, plain), u, g);
            double largest = 0.0;
            for (const double v : g) largest = std::max(largest, std::abs(v));
            for (std::size_t i = 0; i < f.size(); ++i) ck_assert(std::abs(f[i] - g[i]) < 1e-11 * largest);
            const auto s = centre_stress(mesh, std::span(&projected, 1), u),
                       t = centre_stress(mesh, std::span(&plain, 1), u);
            double most = 0.0;
            for (const double v : t) most = std::max(most, std::abs(v));
            for (std::size_t i = 0; i < s.size(); ++i) ck_assert(std::abs(s[i] - t[i]) < 1e-11 * most);
        }
}

TEST(rank) {
    for (const CellType type : projected_types)
        for (const Material& material : materials()) {
            const Mesh mesh = distorted(type, 1);
            const SparseMatrix k = stiffness(mesh, {material, Plane::strain, Formulation::mean_dilatation});
            DenseMatrix full(k.rows, k.rows);
            for (std::int64_t r = 0; r < k.rows; ++r)
                for (auto e = k.start[size(r)]; e < k.start[size(r) + 1]; ++e)
                    full(r, k.column[size(e)]) = k.value[size(e)];
            for (std::int64_t r = 0; r < k.rows; ++r)
                for (std::int64_t c = 0; c < r; ++c) ck_assert(full(r, c) == full(c, r));
            const Eigen eigen = eigen_symmetric(full);
            const std::size_t motions = mesh.dimension() == 2 ? 3 : 6;
            const double stiffest = eigen.value.back();
            for (std::size_t i = 0; i < motions; ++i) ck_assert(std::abs(eigen.value[i]) < 1e-12 * stiffest);
            ck_assert_msg(eigen.value[motions] > 1e-3, "%s: %g of %g", topology(type).name, eigen.value[motions],
                          stiffest);
        }
}

TEST(refused) {
    for (const CellType type : {CellType::tri3, CellType::tet4}) {
        const std::string said = unit::refusal(DELAM_ERROR_ARGUMENT, [&] {
            require_formulation(distorted(type, 1), 0, Formulation::mean_dilatation, -1);
        });
        ck_assert(
            said.find(topology(type).name) != std::string::npos && said.find("constant already") != std::string::npos &&
            said.find(
                "allowed are quad4, hex8, tri6, quad8, quad9, tet10, hex20, hex27, wedge6, pyramid5 and wedge15") !=
                std::string::npos);
    }
}
