// SPDX-License-Identifier: BSD-3-Clause
#include "body/cell_strains.hpp"

#include <algorithm>
#include <cmath>

#include "base/numbers.hpp"
#include "linalg/dense/small_solve.hpp"

namespace delam {

namespace {

constexpr std::size_t most_modes = 9;  // of a hex8: three, each in three directions

constexpr std::size_t strains_in(std::size_t dim) { return dim == 2 ? 3 : 6; }

constexpr std::size_t shear(std::size_t dim, std::size_t i, std::size_t j) {
    return dim == 2 ? 2 : i + j == 1 ? 3 : i + j == 3 ? 4 : 5;
}

// Adds the strains of a displacement of this size in direction i, of which `gradient` is the gradient.
template <std::size_t dim>
void add_strain(std::size_t i, const double* gradient, double size, double* strain) {
    for (std::size_t j = 0; j < dim; ++j) strain[i == j ? i : shear(dim, i, j)] += size * gradient[j];
}

// The internal modes of element.cpp: mode m in direction i has the gradient (det J_0 / det J) J_0^-T (-2 xi_m e_m). Its
// strains are a number that depends on the point and on m, times strains that do not depend on the point.
template <std::size_t dim>
class Modes {
public:
    static constexpr std::size_t count = dim * dim, strains = strains_in(dim);
    using Strains = std::array<double, strains>;

    Modes(CellType type, std::span<const double> coordinates) {
        const PhysicalGradient centre = physical_gradient(type, coordinates, centre_gradient(type));
        jacobian_ = centre.jacobian;
        // Row m of J_0^-1 = dxi_m / dx = sum_a xi_m(node a) dN_a/dx, since shape functions reproduce xi.
        std::array<double, dim * dim> inverse{};
        const std::span<const ReferencePoint> nodes = reference_nodes(type);
        for (std::size_t a = 0; a < nodes.size(); ++a)
            for (std::size_t m = 0; m < dim; ++m)
                for (std::size_t j = 0; j < dim; ++j)
                    inverse[m * dim + j] += nodes[a][m] * centre.gradient[a * dim + j];
        for (std::size_t m = 0; m < dim; ++m)
            for (std::size_t i = 0; i < dim; ++i)
                add_strain<dim>(i, &inverse[m * dim], 1.0, strain_[m * dim + i].data());
    }
    // Mode a = (m, i) is m dim + i.
    const Strains& strain(std::size_t a) const { return strain_[a]; }
    // The number of m at a point with this Jacobian.
    double size(const ReferencePoint& point, double jacobian, std::size_t m) const {
        return -2.0 * point[m] * jacobian_ / jacobian;
    }

private:
    double jacobian_ = 0.0;  // at the centre
    std::array<Strains, count> strain_{};
};

// Sizes a of the modes that minimise the energy,  K_aa a = -K_au u. Adds their strains, or only counts the energy
// 1/2 u^T K_ua K_aa^-1 K_au u = -1/2 a^T K_au u  that they would take off.
template <std::size_t dim>
void bend(CellType type, std::span<const double> coordinates, std::span<const double> elasticity, bool add,
          std::span<const double> jacobian, CellStrains& cell) {
    using Own = Modes<dim>;
    constexpr std::size_t n = Own::count, strains = Own::strains;
    const Own modes(type, coordinates);
    const Quadrature& gauss = quadrature(type);
    const std::size_t points = gauss.points.size();
    std::array<std::array<double, dim>, most_gauss_points> at;
    std::array<double, dim * dim> squares{};                   // sum over the points of the products of two numbers
    std::array<std::array<double, strains>, dim> displaced{};  // and of each with the strains of the displacements
    for (std::size_t q = 0; q < points; ++q)
        for (std::size_t m = 0; m < dim; ++m) {
            at[q][m] = modes.size(gauss.points[q], jacobian[q], m);
            const double weighted = cell.volume[q] * at[q][m];
            for (std::size_t k = 0; k <= m; ++k) squares[m * dim + k] += weighted * at[q][k];
            for (std::size_t s = 0; s < strains; ++s) displaced[m][s] += weighted * cell.strain[q * most_strains + s];
        }
    std::array<double, most_modes * most_modes> stiffness;
    std::array<double, most_modes> right{}, size;
    for (std::size_t a = 0; a < n; ++a) {
        std::array<double, strains> stress{};
        for (std::size_t r = 0; r < strains; ++r)
            for (std::size_t c = 0; c < strains; ++c) stress[c] += modes.strain(a)[r] * elasticity[r * strains + c];
        const auto energy = [&](const std::array<double, strains>& strain) {
            double sum = 0.0;
            for (std::size_t c = 0; c < strains; ++c) sum += stress[c] * strain[c];
            return sum;
        };
        right[a] = -energy(displaced[a / dim]);
        for (std::size_t b = 0; b <= a; ++b)
            stiffness[a * most_modes + b] = squares[a / dim * dim + b / dim] * energy(modes.strain(b));
    }
    size = right;
    small_solve(n, most_modes, stiffness.data(), size.data());
    if (!add) {
        for (std::size_t a = 0; a < n; ++a) cell.excess += 0.5 * size[a] * right[a];
        return;
    }
    for (std::size_t q = 0; q < points; ++q)
        for (std::size_t a = 0; a < n; ++a)
            for (std::size_t s = 0; s < strains; ++s)
                cell.strain[q * most_strains + s] += size[a] * at[q][a / dim] * modes.strain(a)[s];
}

// (P div u - div u) / 3, P projecting onto 1, or onto 1 and x - x_0, as in element.cpp.
void project(CellType type, std::span<const double> coordinates, CellStrains& cell) {
    const CellRow& row = cell_row(type);
    const auto dim = index(row.topology.dimension);
    const Quadrature& gauss = quadrature(type);
    const std::size_t functions = row.dilatations(), points = gauss.points.size();
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

template <std::size_t dim>
CellStrains strains_of(CellType type, std::span<const double> coordinates, std::span<const double> elasticity,
                       Formulation formulation, std::span<const double> displacement) {
    const CellRow& row = cell_row(type);
    const Quadrature& gauss = quadrature(type);
    CellStrains cell;
    std::array<double, most_gauss_points> jacobian;
    for (std::size_t q = 0; q < gauss.points.size(); ++q) {
        const PhysicalGradient at = physical_gradient(type, coordinates, gauss.gradients[q]);
        jacobian[q] = at.jacobian;
        cell.volume[q] = gauss.weights[q] * at.jacobian;
        for (std::size_t a = 0; a < index(row.topology.nodes); ++a)
            for (std::size_t i = 0; i < dim; ++i)
                add_strain<dim>(i, &at.gradient[a * dim], displacement[a * dim + i], &cell.strain[q * most_strains]);
    }
    if (formulation == Formulation::mean_dilatation && !row.one_strain())
        project(type, coordinates, cell);
    else if (row.has_modes())
        bend<dim>(type, coordinates, elasticity, formulation == Formulation::incompatible, jacobian, cell);
    return cell;
}

}  // namespace

CellStrains cell_strains(CellType type, std::span<const double> coordinates, std::span<const double> elasticity,
                         Formulation formulation, std::span<const double> displacement) {
    return topology(type).dimension == 2 ? strains_of<2>(type, coordinates, elasticity, formulation, displacement)
                                         : strains_of<3>(type, coordinates, elasticity, formulation, displacement);
}

}  // namespace delam
