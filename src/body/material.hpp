// SPDX-License-Identifier: BSD-3-Clause
// Linear elasticity as a matrix between engineering strains and stresses, in the order xx, yy, zz, 2xy, 2yz, 2zx.
#pragma once

#include <array>
#include <string>
#include <variant>
#include <vector>

namespace delam {

enum class Plane { strain, stress };

struct Elastic {
    double young = 0.0;    // F/L2, > 0
    double poisson = 0.0;  // -1 < nu < 1/2

    bool operator==(const Elastic& other) const = default;
};

// Three planes of symmetry, normal to the material axes 1, 2, 3. nu_ij: contraction along j under tension along i, so
// nu_ij / E_i = nu_ji / E_j. Transversely isotropic about 1: E3 = E2, nu13 = nu12, G13 = G12, G23 = E2 / (2 (1 +
// nu23)).
struct Orthotropic {
    enum Constant { e1, e2, e3, nu12, nu13, nu23, g12, g13, g23 };
    std::array<double, 9> constant{};

    bool operator==(const Orthotropic& other) const = default;
};

using Material = std::variant<Elastic, Orthotropic>;

// A symmetric 6x6 matrix, row-major, both triangles.
using SpaceElasticity = std::array<double, 36>;

// Row-major: 2D 3x3 over (xx, yy, 2xy), plane strain or stress; 3D 6x6.
std::vector<double> elasticity_matrix(const Elastic& material, int dimension, Plane plane);

// Returns the elasticity in material axes. The material must be positive definite.
SpaceElasticity space_elasticity(const Material& material);
// The constant that makes the elasticity indefinite, its value and its bound; "": none.
std::string indefinite_constant(const Orthotropic& material);

// The same elasticity in global axes; rows of `axes`: the material axes in space, orthonormal.
SpaceElasticity rotated(const SpaceElasticity& elasticity, const std::array<double, 9>& axes);
// Engineering strains in global axes from strains in material axes.
std::array<double, 6> rotated_strain(const std::array<double, 6>& strain, const std::array<double, 9>& axes);

// The in-plane rows, xx, yy, 2xy: plane strain drops the others, plane stress sets their stresses to zero.
std::array<double, 9> plane_elasticity(const SpaceElasticity& elasticity, Plane plane);

}  // namespace delam
