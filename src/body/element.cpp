// SPDX-License-Identifier: BSD-3-Clause
#include "body/element.hpp"

#include <array>
#include <cstddef>

namespace delam {

namespace {

constexpr std::size_t strain_count(std::size_t dim) { return dim == 2 ? 3 : 6; }

// Place of the strain component ij in the order xx, yy, 2xy and xx, yy, zz, 2xy, 2yz, 2zx.
constexpr std::size_t voigt(std::size_t dim, std::size_t i, std::size_t j) {
    if (i == j) return i;
    return dim == 2 ? 2 : i + j == 1 ? 3 : i + j == 3 ? 4 : 5;
}

template <std::size_t dim>
using Matrix = std::array<double, dim * dim>;

// Cofactors of J, C = det(J) J^-T, so that  det(J) dN/dx = C dN/dxi.
template <std::size_t dim>
Matrix<dim> cofactors(const Matrix<dim>& j) {
    if constexpr (dim == 2) {
        return {j[3], -j[2], -j[1], j[0]};
    } else {
        return {j[4] * j[8] - j[5] * j[7], j[5] * j[6] - j[3] * j[8], j[3] * j[7] - j[4] * j[6],
                j[2] * j[7] - j[1] * j[8], j[0] * j[8] - j[2] * j[6], j[1] * j[6] - j[0] * j[7],
                j[1] * j[5] - j[2] * j[4], j[2] * j[3] - j[0] * j[5], j[0] * j[4] - j[1] * j[3]};
    }
}

template <std::size_t dim>
double determinant(const Matrix<dim>& j, const Matrix<dim>& cofactor) {
    double det = 0.0;
    for (std::size_t i = 0; i < dim; ++i) det += j[i] * cofactor[i];
    return det;
}

// J_ij = dx_i/dxi_j = sum_a x_ai dN_a/dxi_j.
template <std::size_t nodes, std::size_t dim>
Matrix<dim> tangent(const double* x, const double* gradient) {
    Matrix<dim> j{};
    for (std::size_t a = 0; a < nodes; ++a)
        for (std::size_t r = 0; r < dim; ++r)
            for (std::size_t c = 0; c < dim; ++c) j[r * dim + c] += x[a * dim + r] * gradient[a * dim + c];
    return j;
}

// K_ai,bk = sum_jl D_(ij)(kl) T_ab,jl,  T_ab,jl = int dN_a/dx_j dN_b/dx_l dx : the points of the quadrature see only
// gradients, the elasticity enters once for each pair of nodes. Pairs a <= b are summed and their transposes copied, so
// that K equals its transpose bit for bit.
template <std::size_t nodes, std::size_t dim>
void stiffness(const double* coordinates, const Quadrature& gauss, const double* elasticity, double* k) {
    constexpr std::size_t strains = strain_count(dim);
    constexpr std::size_t size = nodes * dim;
    constexpr std::size_t square = dim * dim;
    double x[size];  // relative to the first node: sums then do not cancel for a cell far from the origin
    for (std::size_t i = 0; i < size; ++i) x[i] = coordinates[i] - coordinates[i % dim];

    double product[nodes * (nodes + 1) / 2 * square] = {};  // T of the pairs a <= b
    for (std::size_t q = 0; q < gauss.points.size(); ++q) {
        const double* reference = gauss.gradients[q].data();
        const Matrix<dim> j = tangent<nodes, dim>(x, reference);
        const Matrix<dim> cofactor = cofactors<dim>(j);
        const double factor = gauss.weights[q] / determinant<dim>(j, cofactor);  // of det dN/dx, twice
        double g[size];
        for (std::size_t a = 0; a < nodes; ++a)
            for (std::size_t i = 0; i < dim; ++i) {
                double sum = 0.0;
                for (std::size_t c = 0; c < dim; ++c) sum += cofactor[i * dim + c] * reference[a * dim + c];
                g[a * dim + i] = sum;
            }
        double* t = product;
        for (std::size_t a = 0; a < nodes; ++a) {
            double left[dim];
            for (std::size_t i = 0; i < dim; ++i) left[i] = factor * g[a * dim + i];
            for (std::size_t b = a; b < nodes; ++b, t += square)
                for (std::size_t i = 0; i < dim; ++i)
                    for (std::size_t l = 0; l < dim; ++l) t[i * dim + l] += left[i] * g[b * dim + l];
        }
    }

    const double* t = product;
    for (std::size_t a = 0; a < nodes; ++a) {
        for (std::size_t b = a; b < nodes; ++b, t += square) {
            for (std::size_t i = 0; i < dim; ++i) {
                for (std::size_t m = (a == b ? i : 0); m < dim; ++m) {
                    double sum = 0.0;
                    for (std::size_t r = 0; r < dim; ++r)
                        for (std::size_t l = 0; l < dim; ++l)
                            sum += elasticity[voigt(dim, i, r) * strains + voigt(dim, m, l)] * t[r * dim + l];
                    k[(a * dim + i) * size + b * dim + m] = sum;
                    k[(b * dim + m) * size + a * dim + i] = sum;
                }
            }
        }
    }
}

}  // namespace

void element_stiffness(CellType type, std::span<const double> coordinates, std::span<const double> elasticity,
                       std::span<double> matrix) {
    const Quadrature& gauss = quadrature(type);
    const double* x = coordinates.data();
    const double* d = elasticity.data();
    double* k = matrix.data();
    switch (type) {
        case CellType::tri3: return stiffness<3, 2>(x, gauss, d, k);
        case CellType::quad4: return stiffness<4, 2>(x, gauss, d, k);
        case CellType::tet4: return stiffness<4, 3>(x, gauss, d, k);
        case CellType::hex8: return stiffness<8, 3>(x, gauss, d, k);
        case CellType::tri6: return stiffness<6, 2>(x, gauss, d, k);
        case CellType::quad8: return stiffness<8, 2>(x, gauss, d, k);
        case CellType::quad9: return stiffness<9, 2>(x, gauss, d, k);
        case CellType::tet10: return stiffness<10, 3>(x, gauss, d, k);
        case CellType::hex20: return stiffness<20, 3>(x, gauss, d, k);
    }
}

// eps_ij = (u_i,j + u_j,i)/2, the shear components doubled.
std::vector<double> centre_strain(CellType type, std::span<const double> coordinates,
                                  std::span<const double> displacement) {
    const CellTopology& shape = topology(type);
    const auto dim = static_cast<std::size_t>(shape.dimension);
    const PhysicalGradient at_centre = physical_gradient(type, coordinates, centre(type));
    std::vector<double> strain(strain_count(dim), 0.0);
    for (std::size_t a = 0; a < static_cast<std::size_t>(shape.nodes); ++a)
        for (std::size_t i = 0; i < dim; ++i)
            for (std::size_t j = 0; j < dim; ++j)
                strain[voigt(dim, i, j)] += at_centre.gradient[a * dim + j] * displacement[a * dim + i];
    return strain;
}

}  // namespace delam
