// SPDX-License-Identifier: BSD-3-Clause
#include "body/cell_strains.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/numbers.hpp"
#include "linalg/dense/small_solve.hpp"

namespace delam {

namespace {

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

// The inverse of a positive definite matrix [n][n], of which the lower triangle is given.
std::vector<double> small_inverse(std::size_t n, std::span<const double> matrix) {
    std::vector<double> inverse(n * n);
    for (std::size_t k = 0; k < n; ++k) {
        std::vector<double> factor(matrix.begin(), matrix.end()), column(n, 0.0);
        column[k] = 1.0;
        small_solve(n, n, factor.data(), column.data());
        for (std::size_t i = 0; i < n; ++i) inverse[i * n + k] = column[i];
    }
    return inverse;
}

}  // namespace

StrainedCell::StrainedCell(CellType type, std::span<const double> coordinates, std::span<const double> elasticity,
                           Formulation formulation)
    : dimension_(index(topology(type).dimension)),
      nodes_(index(topology(type).nodes)),
      points_(quadrature(type).points.size()) {
    const CellRow& row = cell_row(type);
    const Quadrature& gauss = quadrature(type);
    std::vector<double> jacobian(points_);
    for (std::size_t q = 0; q < points_; ++q) {
        const PhysicalGradient at = physical_gradient(type, coordinates, gauss.gradients[q]);
        jacobian[q] = at.jacobian;
        volume_.push_back(gauss.weights[q] * at.jacobian);
        gradient_.insert(gradient_.end(), at.gradient.begin(),
                         at.gradient.begin() + static_cast<std::ptrdiff_t>(nodes_ * dimension_));
    }
    if (formulation == Formulation::mean_dilatation && !row.one_strain()) {
        take_projection(type, coordinates);
    } else if (row.has_modes()) {
        adds_modes_ = formulation == Formulation::incompatible;
        dimension_ == 2 ? take_modes<2>(type, coordinates, elasticity, jacobian)
                        : take_modes<3>(type, coordinates, elasticity, jacobian);
    }
}

// Sizes a of the modes that minimise the energy,  K_aa a = -K_au u.
template <std::size_t dim>
void StrainedCell::take_modes(CellType type, std::span<const double> coordinates, std::span<const double> elasticity,
                              std::span<const double> jacobian) {
    using Own = Modes<dim>;
    constexpr std::size_t n = Own::count, strains = Own::strains;
    const Own modes(type, coordinates);
    std::array<double, dim * dim> squares{};  // sum over the points of the products of two numbers
    for (std::size_t q = 0; q < points_; ++q)
        for (std::size_t m = 0; m < dim; ++m) {
            mode_.push_back(modes.size(quadrature(type).points[q], jacobian[q], m));
            for (std::size_t k = 0; k <= m; ++k)
                squares[m * dim + k] += volume_[q] * mode_[q * dim + m] * mode_[q * dim + k];
        }
    std::array<double, n * n> stiffness;
    mode_stress_.assign(n * strains, 0.0);
    for (std::size_t a = 0; a < n; ++a) {
        mode_strain_.insert(mode_strain_.end(), modes.strain(a).begin(), modes.strain(a).end());
        double* stress = &mode_stress_[a * strains];
        for (std::size_t r = 0; r < strains; ++r)
            for (std::size_t c = 0; c < strains; ++c) stress[c] += modes.strain(a)[r] * elasticity[r * strains + c];
        for (std::size_t b = 0; b <= a; ++b) {
            double energy = 0.0;
            for (std::size_t c = 0; c < strains; ++c) energy += stress[c] * modes.strain(b)[c];
            stiffness[a * n + b] = squares[a / dim * dim + b / dim] * energy;
        }
    }
    mode_flexibility_ = small_inverse(n, stiffness);
}

// (P div u - div u) / 3, P projecting onto 1, or onto 1 and x - x_0, as in element.cpp.
void StrainedCell::take_projection(CellType type, std::span<const double> coordinates) {
    const std::size_t functions = cell_row(type).dilatations(), dim = dimension_;
    std::vector<double> p(points_ * functions, 0.0);
    double size = 0.0;
    for (std::size_t i = dim; i < coordinates.size(); ++i)
        size = std::max(size, std::abs(coordinates[i] - coordinates[i % dim]));
    for (std::size_t q = 0; q < points_; ++q) {
        p[q * functions] = 1.0;
        const ShapeValues n = shape_values(type, quadrature(type).points[q]);
        for (std::size_t i = 0; i + 1 < functions; ++i)
            for (std::size_t a = 0; a < nodes_; ++a)
                p[q * functions + i + 1] += n[a] * (coordinates[a * dim + i] - coordinates[i]) / size;
    }
    std::vector<double> matrix(functions * functions, 0.0);
    for (std::size_t q = 0; q < points_; ++q)
        for (std::size_t m = 0; m < functions; ++m)
            for (std::size_t k = 0; k <= m; ++k)
                matrix[m * functions + k] += volume_[q] * p[q * functions + m] * p[q * functions + k];
    const std::vector<double> inverse = small_inverse(functions, matrix);
    projection_.assign(points_ * points_, 0.0);
    for (std::size_t q = 0; q < points_; ++q)
        for (std::size_t r = 0; r < points_; ++r)
            for (std::size_t m = 0; m < functions; ++m)
                for (std::size_t k = 0; k < functions; ++k)
                    projection_[q * points_ + r] +=
                        p[q * functions + m] * inverse[m * functions + k] * p[r * functions + k] * volume_[r];
}

// Adds the strains of the modes, or only counts the energy  1/2 u^T K_ua K_aa^-1 K_au u = -1/2 a^T K_au u  that they
// would take off.
template <std::size_t dim>
void StrainedCell::bend(CellStrains& cell) const {
    constexpr std::size_t n = dim * dim, strains = strains_in(dim);
    std::array<std::array<double, strains>, dim> displaced{};  // sum of the modes' numbers times the strains
    for (std::size_t q = 0; q < points_; ++q)
        for (std::size_t m = 0; m < dim; ++m) {
            const double weighted = volume_[q] * mode_[q * dim + m];
            for (std::size_t s = 0; s < strains; ++s) displaced[m][s] += weighted * cell.strain[q * most_strains + s];
        }
    std::array<double, n> right{}, size{};
    for (std::size_t a = 0; a < n; ++a)
        for (std::size_t s = 0; s < strains; ++s) right[a] -= mode_stress_[a * strains + s] * displaced[a / dim][s];
    for (std::size_t a = 0; a < n; ++a)
        for (std::size_t b = 0; b < n; ++b) size[a] += mode_flexibility_[a * n + b] * right[b];
    if (!adds_modes_) {
        for (std::size_t a = 0; a < n; ++a) cell.excess += 0.5 * size[a] * right[a];
        return;
    }
    std::array<std::array<double, strains>, dim> own{};  // of all modes with the same number
    for (std::size_t a = 0; a < n; ++a)
        for (std::size_t s = 0; s < strains; ++s) own[a / dim][s] += size[a] * mode_strain_[a * strains + s];
    for (std::size_t q = 0; q < points_; ++q)
        for (std::size_t m = 0; m < dim; ++m)
            for (std::size_t s = 0; s < strains; ++s)
                cell.strain[q * most_strains + s] += mode_[q * dim + m] * own[m][s];
}

template <std::size_t dim>
void StrainedCell::find_in(std::span<const double> displacement, CellStrains& cell) const {
    constexpr std::size_t strains = strains_in(dim);
    cell.excess = 0.0;
    for (std::size_t q = 0; q < points_; ++q) {
        std::array<double, dim * dim> slope{};  // du_i/dx_j
        const double* gradient = &gradient_[q * nodes_ * dim];
        const double* u = displacement.data();
        for (std::size_t a = 0; a < nodes_; ++a, gradient += dim, u += dim)
            for (std::size_t i = 0; i < dim; ++i)
                for (std::size_t j = 0; j < dim; ++j) slope[i * dim + j] += gradient[j] * u[i];
        const std::array<double, most_strains> own = strain_of<dim>(slope.data());
        std::copy_n(own.begin(), strains, &cell.strain[q * most_strains]);
        cell.volume[q] = volume_[q];
        cell.dilatation[q] = 0.0;
    }
    if (!mode_.empty()) bend<dim>(cell);
    if (projection_.empty()) return;
    std::array<double, most_gauss_points> divergence{};
    for (std::size_t q = 0; q < points_; ++q)
        for (std::size_t i = 0; i < dim; ++i) divergence[q] += cell.strain[q * most_strains + i];
    for (std::size_t q = 0; q < points_; ++q) {
        double projected = 0.0;
        for (std::size_t r = 0; r < points_; ++r) projected += projection_[q * points_ + r] * divergence[r];
        cell.dilatation[q] = (projected - divergence[q]) / 3.0;
    }
}

void StrainedCell::find(std::span<const double> displacement, CellStrains& cell) const {
    dimension_ == 2 ? find_in<2>(displacement, cell) : find_in<3>(displacement, cell);
}

CellStrains cell_strains(CellType type, std::span<const double> coordinates, std::span<const double> elasticity,
                         Formulation formulation, std::span<const double> displacement) {
    CellStrains cell;
    StrainedCell(type, coordinates, elasticity, formulation).find(displacement, cell);
    return cell;
}

}  // namespace delam
