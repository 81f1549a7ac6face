// SPDX-License-Identifier: BSD-3-Clause
#include "body/material.hpp"

#include "base/error.hpp"
#include "delam/delam.h"

namespace delam {

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

}  // namespace delam
