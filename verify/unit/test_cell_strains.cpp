// SPDX-License-Identifier: BSD-3-Clause
// The strains of a cell at its Gauss points store the energy of its stiffness, on distorted cells of all types and
// formulations, whose stiffness comes from other code.
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "all_types.hpp"
#include "body/cell_elasticity.hpp"
#include "body/cell_strains.hpp"
#include "body/element.hpp"
#include "check.hpp"
#include "mesh/shape.hpp"

using namespace delam;

namespace {

std::size_t size(std::int64_t n) { return static_cast<std::size_t>(n); }

struct Cell {
    std::vector<double> x, u;
};

// Moves the nodes of the reference cell by a tenth, at random; the displacements are random too.
Cell random_cell(CellType type, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> draw(-1.0, 1.0);
    const auto dim = size(topology(type).dimension);
    Cell cell;
    for (const ReferencePoint& node : reference_nodes(type))
        for (std::size_t i = 0; i < dim; ++i) cell.x.push_back(node[i] + 0.1 * draw(random));
    for (std::size_t i = 0; i < cell.x.size(); ++i) cell.u.push_back(draw(random));
    return cell;
}

double work(std::span<const double> u, std::span<const double> matrix) {
    double sum = 0.0;
    for (std::size_t i = 0; i < u.size(); ++i)
        for (std::size_t j = 0; j < u.size(); ++j) sum += 0.5 * u[i] * matrix[i * u.size() + j] * u[j];
    return sum;
}

// 1/2 int eps : C : eps with all six strains: the projected dilatation also acts out of the plane.
double stored(CellType type, const CellStrains& cell, const SpaceElasticity& c) {
    const bool plane = topology(type).dimension == 2;
    double sum = 0.0;
    for (std::size_t q = 0; q < quadrature(type).points.size(); ++q) {
        const double* own = &cell.strain[q * most_strains];
        std::array<double, 6> e = plane ? std::array<double, 6>{own[0], own[1], 0.0, own[2], 0.0, 0.0}
                                        : std::array<double, 6>{own[0], own[1], own[2], own[3], own[4], own[5]};
        for (std::size_t i = 0; i < 3; ++i) e[i] += cell.dilatation[q];
        for (std::size_t i = 0; i < 6; ++i)
            for (std::size_t j = 0; j < 6; ++j) sum += 0.5 * cell.volume[q] * e[i] * c[i * 6 + j] * e[j];
    }
    return sum;
}

bool has_modes(CellType type) { return type == CellType::quad4 || type == CellType::hex8; }

}  // namespace

TEST(strains_store_the_energy_of_the_stiffness) {
    for (const CellType type : all_types)
        for (const Formulation formulation :
             {Formulation::standard, Formulation::incompatible, Formulation::mean_dilatation})
            for (unsigned seed = 1; seed <= 4; ++seed) {
                const Cell cell = random_cell(type, seed);
                const BodyModel model{Elastic{3.0, 0.4}, Plane::strain, formulation, nullptr};
                CellElasticity elasticity(model, topology(type).dimension);
                const std::span<const double> d = elasticity.matrix(0);
                std::vector<double> matrix(cell.u.size() * cell.u.size());
                if (formulation == Formulation::mean_dilatation)
                    mean_dilatation_stiffness(type, cell.x, d, elasticity.dilatation(0), matrix);
                else
                    element_stiffness(type, cell.x, d, formulation, matrix);
                const double exact = work(cell.u, matrix);
                const CellStrains strains = cell_strains(type, cell.x, d, formulation, cell.u);
                const double found = stored(type, strains, elasticity.space(0));
                ck_assert_msg(std::abs(found - exact) < 1e-12 * exact, "%s %s: %.15g, not %.15g", topology(type).name,
                              name_of(formulation), found, exact);
            }
}

TEST(excess_is_what_the_modes_take_off) {
    for (const CellType type : all_types)
        for (unsigned seed = 1; seed <= 4; ++seed) {
            const Cell cell = random_cell(type, seed);
            const BodyModel model{Elastic{3.0, 0.3}, Plane::strain, Formulation::standard, nullptr};
            CellElasticity elasticity(model, topology(type).dimension);
            const std::span<const double> d = elasticity.matrix(0);
            std::vector<double> hard(cell.u.size() * cell.u.size()), soft = hard;
            element_stiffness(type, cell.x, d, Formulation::standard, hard);
            element_stiffness(type, cell.x, d, Formulation::incompatible, soft);
            const double saved = work(cell.u, hard) - work(cell.u, soft);
            const double excess = cell_strains(type, cell.x, d, Formulation::standard, cell.u).excess;
            ck_assert(has_modes(type) == (excess > 0.0));
            ck_assert_msg(std::abs(excess - saved) < 1e-12 * work(cell.u, hard), "%s: %.15g, not %.15g",
                          topology(type).name, excess, saved);
            ck_assert(cell_strains(type, cell.x, d, Formulation::incompatible, cell.u).excess == 0.0);
        }
}
