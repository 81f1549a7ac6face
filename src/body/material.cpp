// SPDX-License-Identifier: BSD-3-Clause
#include "body/material.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/error.hpp"
#include "delam/delam.h"

namespace delam {

namespace {

// The axes of the six strains.
constexpr std::size_t first_axis[] = {0, 1, 2, 0, 1, 2};
constexpr std::size_t second_axis[] = {0, 1, 2, 1, 2, 0};

// The compliance of the normal strains, scaled to a unit diagonal: 1 -a -b, -a 1 -c, -b -c 1.
struct Coupling {
    double a, b, c;
    explicit Coupling(const Orthotropic& m)
        : a(m.constant[Orthotropic::nu12] * std::sqrt(m.constant[Orthotropic::e2] / m.constant[Orthotropic::e1])),
          b(m.constant[Orthotropic::nu13] * std::sqrt(m.constant[Orthotropic::e3] / m.constant[Orthotropic::e1])),
          c(m.constant[Orthotropic::nu23] * std::sqrt(m.constant[Orthotropic::e3] / m.constant[Orthotropic::e2])) {}
    double determinant() const { return 1.0 - a * a - b * b - c * c - 2.0 * a * b * c; }
};

// Smaller values are rounding.
constexpr double definite = 1e-14;

// M of  strain in material axes = M strain in space:  2 eps_pq = 2 a_pi a_qj eps_ij.
SpaceElasticity strain_rotation(const std::array<double, 9>& a) {
    SpaceElasticity m{};
    for (std::size_t r = 0; r < 6; ++r)
        for (std::size_t c = 0; c < 6; ++c) {
            const std::size_t p = first_axis[r], q = second_axis[r], i = first_axis[c], j = second_axis[c];
            const double one = a[p * 3 + i] * a[q * 3 + j], other = a[p * 3 + j] * a[q * 3 + i];
            m[r * 6 + c] = r < 3 ? one : one + other;
        }
    return m;
}

}  // namespace

// Hooke's law with the Lame constants  mu = E / (2(1+nu)),  lambda = E nu / ((1+nu)(1-2nu)). Plane stress has the
// same form in the plane once lambda is replaced by  2 lambda mu / (lambda + 2 mu) = E nu / (1-nu^2), which makes
// sigma_zz vanish.
std::vector<double> elasticity_matrix(const Elastic& material, int dimension, Plane plane) {
    const double e = material.young;
    const double nu = material.poisson;
    if (!(e > 0.0)) fail(DELAM_ERROR_PROBLEM, "Young's modulus ", e, ": must be > 0");
    if (!(nu > -1.0 && nu < 0.5)) fail(DELAM_ERROR_PROBLEM, "Poisson's ratio ", nu, ": must be in (-1, 1/2)");
    const double mu = e / (2.0 * (1.0 + nu));
    const bool stress = dimension == 2 && plane == Plane::stress;
    const double lambda = stress ? e * nu / ((1.0 + nu) * (1.0 - nu)) : e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));

    const std::size_t normal = dimension == 2 ? 2 : 3;
    const std::size_t size = dimension == 2 ? 3 : 6;
    std::vector<double> matrix(size * size, 0.0);
    for (std::size_t i = 0; i < normal; ++i)
        for (std::size_t j = 0; j < normal; ++j) matrix[i * size + j] = lambda + (i == j ? 2.0 * mu : 0.0);
    for (std::size_t i = normal; i < size; ++i) matrix[i * size + i] = mu;
    return matrix;
}

// The inverse of the compliance  eps_i = sigma_i / E_i - sum_j nu_ij/E_i sigma_j,  by cofactors of its scaled form.
SpaceElasticity space_elasticity(const Material& material) {
    SpaceElasticity d{};
    if (const auto* isotropic = std::get_if<Elastic>(&material)) {
        const std::vector<double> matrix = elasticity_matrix(*isotropic, 3, Plane::strain);
        std::copy(matrix.begin(), matrix.end(), d.begin());
        return d;
    }
    const Orthotropic& m = std::get<Orthotropic>(material);
    const Coupling k(m);
    const double det = k.determinant();
    const double root[] = {std::sqrt(m.constant[Orthotropic::e1]), std::sqrt(m.constant[Orthotropic::e2]),
                           std::sqrt(m.constant[Orthotropic::e3])};
    const double inverse[3][3] = {{1.0 - k.c * k.c, k.a + k.b * k.c, k.b + k.a * k.c},
                                  {k.a + k.b * k.c, 1.0 - k.b * k.b, k.c + k.a * k.b},
                                  {k.b + k.a * k.c, k.c + k.a * k.b, 1.0 - k.a * k.a}};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) d[i * 6 + j] = root[i] * root[j] * inverse[i][j] / det;
    d[3 * 7] = m.constant[Orthotropic::g12];
    d[4 * 7] = m.constant[Orthotropic::g23];
    d[5 * 7] = m.constant[Orthotropic::g13];
    return d;
}

std::string indefinite_constant(const Orthotropic& m) {
    constexpr const char* name[] = {"E1", "E2", "E3", "nu12", "nu13", "nu23", "G12", "G13", "G23"};
    for (std::size_t i = 0; i < 9; ++i) {
        if (!std::isfinite(m.constant[i])) return text(name[i], " = ", m.constant[i], " is not finite");
        const bool modulus = i < Orthotropic::nu12 || i > Orthotropic::nu23;
        if (modulus && !(m.constant[i] > 0.0)) return text(name[i], " = ", m.constant[i], " must be > 0");
    }
    const Coupling k(m);
    const double coupling[] = {k.a, k.b, k.c};
    for (std::size_t p = 0; p < 3; ++p) {
        if (std::abs(coupling[p]) < 1.0) continue;
        const std::size_t i = p == 2 ? 1 : 0, j = p == 0 ? 1 : 2;
        const double largest = std::sqrt(m.constant[i] / m.constant[j]);
        return text(name[3 + p], " = ", m.constant[3 + p], " is outside -", largest, " .. ", largest,
                    ", the square root of ", name[i], "/", name[j], " (nu", j + 1, i + 1, " = ", name[3 + p], " ",
                    name[j], "/", name[i], " = ", m.constant[3 + p] * m.constant[j] / m.constant[i], ")");
    }
    if (k.determinant() > definite) return "";
    // Positive between the roots of 1 - a2 - b2 - c2 - 2abc in c.
    const double reach = std::sqrt((1.0 - k.a * k.a) * (1.0 - k.b * k.b));
    const double scale = std::sqrt(m.constant[Orthotropic::e2] / m.constant[Orthotropic::e3]);
    return text("nu23 = ", m.constant[Orthotropic::nu23], " is outside ", (-k.a * k.b - reach) * scale, " .. ",
                (-k.a * k.b + reach) * scale, ", the range left by nu12 = ", m.constant[Orthotropic::nu12],
                " and nu13 = ", m.constant[Orthotropic::nu13],
                " (1 - nu12 nu21 - nu13 nu31 - nu23 nu32 - 2 nu21 nu32 nu13 = ", k.determinant(), " must be > 0)");
}

// The energy is the same in both axes:  D = M^T D_m M.
SpaceElasticity rotated(const SpaceElasticity& elasticity, const std::array<double, 9>& axes) {
    const SpaceElasticity m = strain_rotation(axes);
    SpaceElasticity half{};
    for (std::size_t r = 0; r < 6; ++r)
        for (std::size_t k = 0; k < 6; ++k) {
            if (elasticity[r * 6 + k] == 0.0) continue;
            for (std::size_t c = 0; c < 6; ++c) half[r * 6 + c] += elasticity[r * 6 + k] * m[k * 6 + c];
        }
    SpaceElasticity d{};
    for (std::size_t r = 0; r < 6; ++r)
        for (std::size_t c = r; c < 6; ++c) {
            double sum = 0.0;
            for (std::size_t k = 0; k < 6; ++k) sum += m[k * 6 + r] * half[k * 6 + c];
            d[r * 6 + c] = sum;
            d[c * 6 + r] = sum;
        }
    return d;
}

std::array<double, 6> rotated_strain(const std::array<double, 6>& strain, const std::array<double, 9>& axes) {
    const std::array<double, 9> back{axes[0], axes[3], axes[6], axes[1], axes[4], axes[7], axes[2], axes[5], axes[8]};
    const SpaceElasticity m = strain_rotation(back);
    std::array<double, 6> out{};
    for (std::size_t r = 0; r < 6; ++r)
        for (std::size_t c = 0; c < 6; ++c) out[r] += m[r * 6 + c] * strain[c];
    return out;
}

// Plane stress: D_ii - D_io D_oo^-1 D_oi with the stresses o = zz, yz, zx zero, by Cholesky's D_oo = L L^T.
std::array<double, 9> plane_elasticity(const SpaceElasticity& d, Plane plane) {
    constexpr std::size_t in[] = {0, 1, 3}, out[] = {2, 4, 5};
    std::array<double, 9> reduced{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) reduced[i * 3 + j] = d[in[i] * 6 + in[j]];
    if (plane == Plane::strain) return reduced;
    double lower[3][3] = {}, v[3][3];  // v = L^-1 D_oi
    for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = 0; c <= r; ++c) {
            double sum = d[out[r] * 6 + out[c]];
            for (std::size_t k = 0; k < c; ++k) sum -= lower[r][k] * lower[c][k];
            lower[r][c] = r == c ? std::sqrt(sum) : sum / lower[c][c];
        }
        for (std::size_t i = 0; i < 3; ++i) {
            double sum = d[out[r] * 6 + in[i]];
            for (std::size_t k = 0; k < r; ++k) sum -= lower[r][k] * v[k][i];
            v[r][i] = sum / lower[r][r];
        }
    }
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = i; j < 3; ++j) {
            double sum = reduced[i * 3 + j];
            for (std::size_t k = 0; k < 3; ++k) sum -= v[k][i] * v[k][j];
            reduced[i * 3 + j] = sum;
            reduced[j * 3 + i] = sum;
        }
    return reduced;
}

}  // namespace delam
