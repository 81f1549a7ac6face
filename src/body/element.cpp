// SPDX-License-Identifier: BSD-3-Clause
#include "body/element.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/numbers.hpp"

namespace delam {

namespace {

constexpr std::size_t strain_count(std::size_t dim) { return dim == 2 ? 3 : 6; }

// Position of the strain component ij in the order xx, yy, 2xy and xx, yy, zz, 2xy, 2yz, 2zx.
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

// T_aj,bl = int dN_a/dx_j dN_b/dx_l dx, row-major, for a <= b. Internal modes count as further nodes.
template <std::size_t nodes, std::size_t dim>
using Products = std::array<double, nodes * dim * nodes * dim>;

// The displacement modes 1 - xi_i^2 of Wilson (1973), which represent bending, in the form of Taylor, Beresford and
// Wilson (Int. J. Numer. Meth. Eng. 10, 1976): their gradients are those at the centre, scaled,
//     dM_i/dx = (det J_0 / det J) J_0^-T dM_i/dxi,
// so that int dM_i/dx dx = 0: a constant stress does no work on them, and the patch test holds on distorted cells.
template <std::size_t nodes, std::size_t dim, std::size_t modes>
void gradient_products(CellType type, const double* coordinates, Products<nodes + modes, dim>& product) {
    constexpr std::size_t size = (nodes + modes) * dim;
    double x[nodes * dim];  // relative to the first node: sums then do not cancel for a cell far from the origin
    for (std::size_t i = 0; i < nodes * dim; ++i) x[i] = coordinates[i] - coordinates[i % dim];
    Matrix<dim> centre_cofactor{};
    if constexpr (modes > 0) centre_cofactor = cofactors<dim>(tangent<nodes, dim>(x, centre_gradient(type).data()));

    const Quadrature& gauss = quadrature(type);
    for (std::size_t q = 0; q < gauss.points.size(); ++q) {
        const double* reference = gauss.gradients[q].data();
        const Matrix<dim> j = tangent<nodes, dim>(x, reference);
        const Matrix<dim> cofactor = cofactors<dim>(j);
        const double factor = gauss.weights[q] / determinant<dim>(j, cofactor);
        double g[size];  // det J dN/dx
        for (std::size_t a = 0; a < nodes; ++a)
            for (std::size_t i = 0; i < dim; ++i) {
                double sum = 0.0;
                for (std::size_t c = 0; c < dim; ++c) sum += cofactor[i * dim + c] * reference[a * dim + c];
                g[a * dim + i] = sum;
            }
        for (std::size_t m = 0; m < modes; ++m)
            for (std::size_t i = 0; i < dim; ++i)
                g[(nodes + m) * dim + i] = centre_cofactor[i * dim + m] * -2.0 * gauss.points[q][m];
        for (std::size_t r = 0; r < size; ++r) {
            const double left = factor * g[r];
            double* row = &product[r * size];
            for (std::size_t c = r / dim * dim; c < size; ++c) row[c] += left * g[c];
        }
    }
}

// True if normal strains cause shear stresses, or one shear strain the stress of another; isotropic materials do
// neither.
template <std::size_t dim>
bool coupled(const double* elasticity) {
    constexpr std::size_t strains = strain_count(dim);
    for (std::size_t r = dim; r < strains; ++r)
        for (std::size_t c = 0; c < r; ++c)
            if (elasticity[r * strains + c] != 0.0 || elasticity[c * strains + r] != 0.0) return true;
    return false;
}

// K_ai,bm = sum_rl D_(ir)(ml) T_ar,bl : the elasticity is applied once for each pair of nodes. Pairs a <= b are
// computed and copied, so that K equals its transpose bit for bit. block(t, k) computes the dim x dim entries of a pair
// from those of T.
template <std::size_t nodes, std::size_t dim, class PairBlock>
void each_pair(const Products<nodes, dim>& product, PairBlock&& block, double* k) {
    constexpr std::size_t size = nodes * dim;
    for (std::size_t a = 0; a < nodes; ++a) {
        for (std::size_t b = a; b < nodes; ++b) {
            double t[dim][dim];
            double entry[dim][dim];
            for (std::size_t i = 0; i < dim; ++i)
                for (std::size_t m = 0; m < dim; ++m) t[i][m] = product[(a * dim + i) * size + b * dim + m];
            block(t, entry);
            for (std::size_t i = 0; i < dim; ++i)
                for (std::size_t m = (a == b ? i : 0); m < dim; ++m) {
                    k[(a * dim + i) * size + b * dim + m] = entry[i][m];
                    k[(b * dim + m) * size + a * dim + i] = entry[i][m];
                }
        }
    }
}

// Without coupling, only D_(ii)(mm) and the terms of one shear strain, ir = ml, remain: 15 instead of 81 in space.
template <std::size_t nodes, std::size_t dim>
void contract(const Products<nodes, dim>& product, const double* elasticity, double* k) {
    constexpr std::size_t strains = strain_count(dim);
    if (coupled<dim>(elasticity)) {
        const auto block = [elasticity](const double(&t)[dim][dim], double(&entry)[dim][dim]) {
            for (std::size_t i = 0; i < dim; ++i)
                for (std::size_t m = 0; m < dim; ++m) {
                    entry[i][m] = 0.0;
                    for (std::size_t r = 0; r < dim; ++r)
                        for (std::size_t l = 0; l < dim; ++l)
                            entry[i][m] += elasticity[voigt(dim, i, r) * strains + voigt(dim, m, l)] * t[r][l];
                }
        };
        return each_pair<nodes, dim>(product, block, k);
    }
    double normal[dim][dim];
    double shear[dim][dim];  // 0 on the diagonal
    for (std::size_t i = 0; i < dim; ++i)
        for (std::size_t m = 0; m < dim; ++m) {
            normal[i][m] = elasticity[i * strains + m];
            shear[i][m] = i == m ? 0.0 : elasticity[voigt(dim, i, m) * (strains + 1)];
        }
    const auto block = [&normal, &shear](const double(&t)[dim][dim], double(&entry)[dim][dim]) {
        for (std::size_t i = 0; i < dim; ++i) {
            for (std::size_t m = 0; m < dim; ++m) entry[i][m] = normal[i][m] * t[i][m] + shear[i][m] * t[m][i];
            for (std::size_t r = 0; r < dim; ++r) entry[i][i] += shear[i][r] * t[r][r];
        }
    };
    each_pair<nodes, dim>(product, block, k);
}

// H_m,ai = int p_m dN_a/dx_i dx and the Cholesky factor of M_mn = int p_m p_n dx, in V = L^-1 H:  int (P dN_a/dx_i)(P
// dN_b/dx_j) = V^T V. p = 1, (x - x_0)/s with the centre x_0 and the size s of the cell.
template <std::size_t nodes, std::size_t dim, std::size_t functions>
struct Projection {
    double v[functions][nodes * dim] = {};
    double lower[functions][functions] = {};

    Projection(CellType type, const double* coordinates) {
        double x[nodes * dim];
        for (std::size_t i = 0; i < nodes * dim; ++i) x[i] = coordinates[i] - coordinates[i % dim];
        const ShapeValues middle = shape_values(type, centre(type));
        double origin[dim] = {}, size = 0.0;
        for (std::size_t i = 0; i < nodes * dim; ++i) {
            origin[i % dim] += middle[i / dim] * x[i];
            size = std::max(size, std::abs(x[i]));
        }
        const Quadrature& gauss = quadrature(type);
        for (std::size_t q = 0; q < gauss.points.size(); ++q) {
            const double* reference = gauss.gradients[q].data();
            const Matrix<dim> j = tangent<nodes, dim>(x, reference);
            const Matrix<dim> cofactor = cofactors<dim>(j);
            const double volume = gauss.weights[q] * determinant<dim>(j, cofactor);
            double p[functions] = {1.0};
            if constexpr (functions > 1) {
                const ShapeValues n = shape_values(type, gauss.points[q]);
                for (std::size_t i = 0; i < dim; ++i) {
                    double place = -origin[i];
                    for (std::size_t a = 0; a < nodes; ++a) place += n[a] * x[a * dim + i];
                    p[i + 1] = place / size;
                }
            }
            for (std::size_t m = 0; m < functions; ++m) {
                for (std::size_t n = 0; n <= m; ++n) lower[m][n] += volume * p[m] * p[n];
                for (std::size_t a = 0; a < nodes; ++a)
                    for (std::size_t i = 0; i < dim; ++i)
                        for (std::size_t c = 0; c < dim; ++c)
                            v[m][a * dim + i] +=
                                gauss.weights[q] * p[m] * cofactor[i * dim + c] * reference[a * dim + c];
            }
        }
        for (std::size_t m = 0; m < functions; ++m) {
            for (std::size_t n = 0; n <= m; ++n) {
                for (std::size_t k = 0; k < n; ++k) lower[m][n] -= lower[m][k] * lower[n][k];
                lower[m][n] = m == n ? std::sqrt(lower[m][m]) : lower[m][n] / lower[n][n];
            }
            for (std::size_t i = 0; i < nodes * dim; ++i) {
                for (std::size_t k = 0; k < m; ++k) v[m][i] -= lower[m][k] * v[k][i];
                v[m][i] /= lower[m][m];
            }
        }
    }

    // Returns the function that approximates the displacement u, at x_0, where p = 1, 0, 0(, 0):  p^T L^-T V u.
    double at_centre(const double* u) const {
        double c[functions];  // L^-1 p
        for (std::size_t m = 0; m < functions; ++m) {
            c[m] = m == 0 ? 1.0 : 0.0;
            for (std::size_t k = 0; k < m; ++k) c[m] -= lower[m][k] * c[k];
            c[m] /= lower[m][m];
        }
        double sum = 0.0;
        for (std::size_t m = 0; m < functions; ++m)
            for (std::size_t i = 0; i < nodes * dim; ++i) sum += c[m] * v[m][i] * u[i];
        return sum;
    }
};

// B-bar (T. Hughes, Int. J. Numer. Meth. Eng. 15, 1980; J. Nagtegaal, D. Parks, J. Rice, CMAME 4, 1974):  eps + 1/3 (P
// div u - div u) I. With the products T of the gradients, R = T - V^T V of what the projection leaves out of them, c =
// C I and its trace,
//   K_ai,bm = D : T  - 1/3 (c_ij R_aj,bm + R_ai,bl c_lm) + 1/9 (I:C:I) R_ai,bm.
template <std::size_t nodes, std::size_t dim, std::size_t functions>
void mean_dilatation(CellType type, const double* x, const double* elasticity, const Dilatation& dilatation,
                     double* k) {
    constexpr std::size_t size = nodes * dim;
    Products<nodes, dim> product{};
    gradient_products<nodes, dim, 0>(type, x, product);
    contract<nodes, dim>(product, elasticity, k);
    const Projection<nodes, dim, functions> projection(type, x);
    double c[dim][dim];
    for (std::size_t i = 0; i < dim; ++i)
        for (std::size_t j = 0; j < dim; ++j) c[i][j] = dilatation.stress[voigt(dim, i, j)];
    for (std::size_t a = 0; a < nodes; ++a)
        for (std::size_t b = a; b < nodes; ++b) {
            double r[dim][dim];
            for (std::size_t i = 0; i < dim; ++i)
                for (std::size_t m = 0; m < dim; ++m) {
                    r[i][m] = product[(a * dim + i) * size + b * dim + m];
                    for (std::size_t f = 0; f < functions; ++f)
                        r[i][m] -= projection.v[f][a * dim + i] * projection.v[f][b * dim + m];
                }
            for (std::size_t i = 0; i < dim; ++i)
                for (std::size_t m = (a == b ? i : 0); m < dim; ++m) {
                    double sum = dilatation.bulk / 9.0 * r[i][m];
                    for (std::size_t j = 0; j < dim; ++j) sum -= (c[i][j] * r[j][m] + r[i][j] * c[j][m]) / 3.0;
                    const double entry = k[(a * dim + i) * size + b * dim + m] + sum;
                    k[(a * dim + i) * size + b * dim + m] = entry;
                    k[(b * dim + m) * size + a * dim + i] = entry;
                }
        }
}

template <std::size_t nodes, std::size_t dim>
double gradient_integrals(CellType type, const double* coordinates, double* integral) {
    double x[nodes * dim];
    for (std::size_t i = 0; i < nodes * dim; ++i) x[i] = coordinates[i] - coordinates[i % dim];
    std::fill_n(integral, nodes * dim, 0.0);
    double volume = 0.0;
    const Quadrature& gauss = quadrature(type);
    for (std::size_t q = 0; q < gauss.points.size(); ++q) {
        const double* reference = gauss.gradients[q].data();
        const Matrix<dim> j = tangent<nodes, dim>(x, reference);
        const Matrix<dim> cofactor = cofactors<dim>(j);
        volume += gauss.weights[q] * determinant<dim>(j, cofactor);
        for (std::size_t a = 0; a < nodes; ++a)
            for (std::size_t i = 0; i < dim; ++i)
                for (std::size_t c = 0; c < dim; ++c)
                    integral[a * dim + i] += gauss.weights[q] * cofactor[i * dim + c] * reference[a * dim + c];
    }
    return volume;
}

// Static condensation of the last `modes` of `all` unknowns:  K_uu - K_ua K_aa^-1 K_au = K_uu - V^T V,  V = L^-1 K_au
// with Cholesky's K_aa = L L^T.
template <std::size_t all, std::size_t modes>
void condense(const double* full, double* k) {
    constexpr std::size_t size = all - modes;
    double v[modes][all];  // rows of L^-1 (K_au | K_aa): the last block becomes L^T
    for (std::size_t r = 0; r < modes; ++r) {
        std::copy_n(full + (size + r) * all, all, v[r]);
        for (std::size_t s = 0; s < r; ++s) {
            const double share = v[s][size + r];
            for (std::size_t i = 0; i < all; ++i) v[r][i] -= share * v[s][i];
        }
        const double pivot = std::sqrt(v[r][size + r]);
        for (std::size_t i = 0; i < all; ++i) v[r][i] /= pivot;
    }
    for (std::size_t i = 0; i < size; ++i) {
        for (std::size_t j = i; j < size; ++j) {
            double sum = full[i * all + j];
            for (std::size_t r = 0; r < modes; ++r) sum -= v[r][i] * v[r][j];
            k[i * size + j] = sum;
            k[j * size + i] = sum;
        }
    }
}

template <std::size_t nodes, std::size_t dim>
void standard(CellType type, const double* x, const double* elasticity, double* k) {
    Products<nodes, dim> product{};
    gradient_products<nodes, dim, 0>(type, x, product);
    contract<nodes, dim>(product, elasticity, k);
}

// Translations need no force, K_aa = - sum over b != a of K_ab: the elimination of the modes leaves more rounding in
// the diagonal blocks than in these sums, and bodies that nothing holds would seem to be held by it.
template <std::size_t nodes, std::size_t dim>
void free_translations(double* k) {
    constexpr std::size_t size = nodes * dim;
    for (std::size_t a = 0; a < nodes; ++a) {
        double sum[dim][dim] = {};
        for (std::size_t b = 0; b < nodes; ++b)
            for (std::size_t i = 0; i < dim && b != a; ++i)
                for (std::size_t m = 0; m < dim; ++m) sum[i][m] += k[(a * dim + i) * size + b * dim + m];
        for (std::size_t i = 0; i < dim; ++i)
            for (std::size_t m = 0; m < dim; ++m)
                k[(a * dim + i) * size + a * dim + m] = -0.5 * (sum[i][m] + sum[m][i]);
    }
}

template <std::size_t nodes, std::size_t dim>
void incompatible(CellType type, const double* x, const double* elasticity, double* k) {
    Products<nodes + dim, dim> product{};
    gradient_products<nodes, dim, dim>(type, x, product);
    double full[(nodes + dim) * dim * (nodes + dim) * dim];
    contract<nodes + dim, dim>(product, elasticity, full);
    condense<(nodes + dim) * dim, dim * dim>(full, k);
    free_translations<nodes, dim>(k);
}

// The numbers of a row of cell_rows that the kernels above need at compile time.
template <std::size_t place>
struct Sizes {
    static constexpr const CellRow& row = cell_rows[place];
    static constexpr std::size_t nodes = index(row.topology.nodes);
    static constexpr std::size_t dim = index(row.topology.dimension);
    static constexpr bool modes = row.has_modes();
    static constexpr bool one_strain = row.one_strain();
    static constexpr std::size_t functions = row.dilatations();
};

template <class Visit, std::size_t... places>
void visit_row(CellType type, Visit& visit, std::index_sequence<places...>) {
    const CellRow* row = &cell_row(type);
    ((row == &cell_rows[places] ? visit(Sizes<places>{}) : void()), ...);
}

// visit(Sizes) of the row of a type: each kernel is compiled for every row.
template <class Visit>
void with_sizes(CellType type, Visit&& visit) {
    visit_row(type, visit, std::make_index_sequence<cell_rows.size()>{});
}

}  // namespace

void element_stiffness(CellType type, std::span<const double> coordinates, std::span<const double> elasticity,
                       Formulation formulation, std::span<double> matrix) {
    const double* x = coordinates.data();
    const double* d = elasticity.data();
    double* k = matrix.data();
    with_sizes(type, [&](auto sizes) {
        using Cell = decltype(sizes);
        if constexpr (Cell::modes)
            if (formulation == Formulation::incompatible) return incompatible<Cell::nodes, Cell::dim>(type, x, d, k);
        standard<Cell::nodes, Cell::dim>(type, x, d, k);
    });
}

void mean_dilatation_stiffness(CellType type, std::span<const double> coordinates, std::span<const double> elasticity,
                               const Dilatation& dilatation, std::span<double> matrix) {
    const double* x = coordinates.data();
    const double* d = elasticity.data();
    double* k = matrix.data();
    with_sizes(type, [&](auto sizes) {
        using Cell = decltype(sizes);
        if constexpr (Cell::one_strain)
            standard<Cell::nodes, Cell::dim>(type, x, d, k);
        else
            mean_dilatation<Cell::nodes, Cell::dim, Cell::functions>(type, x, d, dilatation, k);
    });
}

double dilatation_correction(CellType type, std::span<const double> coordinates, std::span<const double> displacement) {
    double projected = 0.0;
    with_sizes(type, [&](auto sizes) {
        using Cell = decltype(sizes);
        const Projection<Cell::nodes, Cell::dim, Cell::functions> projection(type, coordinates.data());
        projected = projection.at_centre(displacement.data());
    });
    const PhysicalGradient at = physical_gradient(type, coordinates, centre_gradient(type));
    for (std::size_t i = 0; i < coordinates.size(); ++i) projected -= at.gradient[i] * displacement[i];
    return projected;
}

double integrate_gradients(CellType type, std::span<const double> coordinates, std::span<double> integral) {
    double volume = 0.0;
    with_sizes(type, [&](auto sizes) {
        using Cell = decltype(sizes);
        volume = gradient_integrals<Cell::nodes, Cell::dim>(type, coordinates.data(), integral.data());
    });
    return volume;
}

}  // namespace delam
