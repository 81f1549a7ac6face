// SPDX-License-Identifier: BSD-3-Clause
// Isotropic linear elasticity as a matrix between engineering strains and stresses.
#pragma once

#include <vector>

namespace delam {

enum class Plane { strain, stress };

struct Elastic {
    double young = 0.0;    // F/L2, > 0
    double poisson = 0.0;  // -1 < nu < 1/2

    bool operator==(const Elastic& other) const = default;
};

// Row-major: 2D 3x3 over (xx, yy, 2xy), plane strain or stress; 3D 6x6 over (xx, yy, zz, 2xy, 2yz, 2zx).
std::vector<double> elasticity_matrix(const Elastic& material, int dimension, Plane plane);

}  // namespace delam
