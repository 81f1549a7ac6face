// SPDX-License-Identifier: BSD-3-Clause
#include "body/cell_strains.hpp"

#include <algorithm>
#include <cmath>

#include "base/numbers.hpp"
#include "linalg/dense/small_solve.hpp"

namespace delam {

namespace {

constexpr std::size_t most_modes = 9;  // of a hex8: three, each in three directions

std::size_t shear(std::size_t dim, std::size_t i, std::size_t j) {
    return dim == 2 ? 2 : i + j == 1 ? 3 : i + j == 3 ? 4 : 5;
}

// Adds the strains of a displacement of this size in direction i, of which `gradient` is the gradient.
void add_strain(std::size_t dim, std::size_t i, const double* gradient, double size, double* strain) {
    for (std::size_t j = 0; j < dim; ++j) strain[i == j ? i : shear(dim, i, j)] += size * gradient[j];
}

// The internal modes of element.cpp: mode m in direction i has the gradient (det J_0 / det J) J_0^-T (-2 xi_m e_m).
class Modes {
public:
    Modes(CellType type, std::span<const double> coordinates)
        : dim_(index(topology(type).dimension)),
          at_centre_(physical_gradient(type, coordinates, centre_gradient(type))) {
        // Row m of J_0^-1 = dxi_m / dx = sum_a xi_m(node a) dN_a/dx, since shape functions reproduce xi.
        const std::span<const ReferencePoint> nodes = reference_nodes(type);
        for (std::size_t a = 0; a < nodes.size(); ++a)
            for (std::size_t m = 0; m < dim_; ++m)
                for (std::size_t j = 0; j < dim_; ++j)
                    inverse_[m * 3 + j] += nodes[a][m] * at_centre_.gradient[a * dim_ + j];
    }
    std::size_t count() const { return dim_ * dim_; }
    // Strains of the modes at a point with this Jacobian, [modes][most_strains].
    void strains(const ReferencePoint& at, double jacobian, double* strain) const {
        std::fill_n(strain, count() * most_strains, 0.0);
        for (std::size_t m = 0; m < dim_; ++m)
            for (std::size_t i = 0; i < dim_; ++i)
                add_strain(dim_, i, &inverse_[m * 3], -2.0 * at[m] * at_centre_.jacobian / jacobian,
                           strain + (m * dim_ + i) * most_strains);
    }

private:
    std::size_t dim_;
    PhysicalGradient at_centre_;
    std::array<double, 9> inverse_{};
};

double product(std::size_t strains, const double* left, std::span<const double> elasticity, const double* right) {
    double sum = 0.0;
    for (std::size_t r = 0; r < strains; ++r)
        for (std::size_t c = 0; c < strains; ++c) sum += left[r] * elasticity[r * strains + c] * right[c];
    return sum;
}

// Sizes a of the modes that minimise the energy,  K_aa a = -K_au u. Adds their strains, or only counts the energy
// 1/2 u^T K_ua K_aa^-1 K_au u = -1/2 a^T K_au u  that they would take off.
void bend(CellType type, std::span<const double> coordinates, std::span<const double> elasticity, bool add,
          std::span<const double> jacobian, CellStrains& cell) {
    const Modes modes(type, coordinates);
    const Quadrature& gauss = quadrature(type);
    const std::size_t n = modes.count(), strains = n == 4 ? 3 : 6, points = gauss.points.size();
    std::array<double, most_modes * most_modes> stiffness{};
    std::array<double, most_modes> right{}, size{};
    std::array<double, most_modes * most_strains> own{};
    for (std::size_t q = 0; q < points; ++q) {
        modes.strains(gauss.points[q], jacobian[q], own.data());
        for (std::size_t a = 0; a < n; ++a) {
            right[a] -=
                cell.volume[q] * product(strains, &own[a * most_strains], elasticity, &cell.strain[q * most_strains]);
            for (std::size_t b = 0; b <= a; ++b)
                stiffness[a * most_modes + b] +=
                    cell.volume[q] * product(strains, &own[a * most_strains], elasticity, &own[b * most_strains]);
        }
    }
    size = right;
    small_solve(n, most_modes, stiffness.data(), size.data());
    if (!add) {
        for (std::size_t a = 0; a < n; ++a) cell.excess += 0.5 * size[a] * right[a];
        return;
    }
    for (std::size_t q = 0; q < points; ++q) {
        modes.strains(gauss.points[q], jacobian[q], own.data());
        for (std::size_t a = 0; a < n; ++a)
            for (std::size_t s = 0; s < strains; ++s)
                cell.strain[q * most_strains + s] += size[a] * own[a * most_strains + s];
    }
}

// (P div u - div u) / 3, P projecting onto 1, or onto 1 and x - x_0, as in element.cpp.
void project(CellType type, std::span<const double> coordinates, CellStrains& cell) {
    const CellRow& row = cell_row(type);
    const auto dim = index(row.topology.dimension);
    const Quadrature& gauss = quadrature(type);
    const std::size_t functions = row.simplex() || row.linear() ? 1 : dim + 1, points = gauss.points.size();
    std::array<double, most_gauss_points * 4> p{};
    double size = 0.0;
    for (std::size_t i = dim; i < coordinates.size(); ++i)
        size = std::max(size, std::abs(coordinates[i] - coordinates[i % dim]));
    for (std::size_t q = 0; q < points; ++q) {
        p[q * 4] = 1.0;
        const ShapeValues n = shape_values(type, gauss.points[q]);
        for (std::size_t i = 0; i + 1 < functions; ++i)
            for (std::size_t a = 0; a < index(row.topology.nodes); ++a)
                p[q * 4 + i + 1] += n[a] * (coordinates[a * dim + i] - coordinates[i]) / size;
    }
    std::array<double, 16> matrix{};
    std::array<double, 4> factor{};
    const auto divergence = [&](std::size_t q) {
        double sum = 0.0;
        for (std::size_t i = 0; i < dim; ++i) sum += cell.strain[q * most_strains + i];
        return sum;
    };
    for (std::size_t q = 0; q < points; ++q)
        for (std::size_t m = 0; m < functions; ++m) {
            factor[m] += cell.volume[q] * p[q * 4 + m] * divergence(q);
            for (std::size_t k = 0; k <= m; ++k) matrix[m * 4 + k] += cell.volume[q] * p[q * 4 + m] * p[q * 4 + k];
        }
    small_solve(functions, 4, matrix.data(), factor.data());
    for (std::size_t q = 0; q < points; ++q) {
        double projected = 0.0;
        for (std::size_t m = 0; m < functions; ++m) projected += factor[m] * p[q * 4 + m];
        cell.dilatation[q] = (projected - divergence(q)) / 3.0;
    }
}

}  // namespace

CellStrains cell_strains(CellType type, std::span<const double> coordinates, std::span<const double> elasticity,
                         Formulation formulation, std::span<const double> displacement) {
    const CellRow& row = cell_row(type);
    const auto dim = index(row.topology.dimension);
    const Quadrature& gauss = quadrature(type);
    CellStrains cell;
    std::array<double, most_gauss_points> jacobian{};
    for (std::size_t q = 0; q < gauss.points.size(); ++q) {
        const PhysicalGradient at = physical_gradient(type, coordinates, gauss.gradients[q]);
        jacobian[q] = at.jacobian;
        cell.volume[q] = gauss.weights[q] * at.jacobian;
        for (std::size_t a = 0; a < index(row.topology.nodes); ++a)
            for (std::size_t i = 0; i < dim; ++i)
                add_strain(dim, i, &at.gradient[a * dim], displacement[a * dim + i], &cell.strain[q * most_strains]);
    }
    const bool simplex = row.simplex(), linear = row.linear();
    if (formulation == Formulation::mean_dilatation && !(simplex && linear))
        project(type, coordinates, cell);
    else if (!simplex && linear)
        bend(type, coordinates, elasticity, formulation == Formulation::incompatible, jacobian, cell);
    return cell;
}

}  // namespace delam
