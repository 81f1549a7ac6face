// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/sparse/body_states.hpp"

#include <cmath>
#include <limits>

#include "base/numbers.hpp"
#include "linalg/dense/dense.hpp"

namespace delam {

void recover_state(const BodySystem& bodies, std::span<const double> theta, std::span<const double> x,
                   std::vector<double>& displacement, std::vector<double>& stressed) {
    displacement = bodies.lift(theta);
    bodies.add_variables(x, displacement);
    stressed = bodies.stressed(displacement);
}

BodySolver::Work work_of_state(const BodySystem& bodies, std::span<const double> theta, std::span<const double> x) {
    std::vector<double> u, stressed;
    recover_state(bodies, theta, x, u, stressed);
    BodySolver::Work work;
    work.strain = 0.5 * dot(u, stressed);
    const std::vector<std::vector<double>>& force = bodies.force();
    for (std::size_t p = 0; p < theta.size(); ++p)
        if (!force[p].empty() && theta[p] != 0.0) add_scaled(-theta[p], force[p], stressed);
    for (std::size_t p = 0; p < theta.size(); ++p) {
        work.lifted.push_back(dot(bodies.variables().lift[p], stressed));
        work.done.push_back(force[p].empty() ? 0.0 : dot(force[p], u));
    }
    return work;
}

double energy_rounding_of_state(const BodySystem& bodies, std::span<const double> theta, std::span<const double> x) {
    std::vector<double> u, stressed;
    recover_state(bodies, theta, x, u, stressed);
    double energy = 0.5 * dot(u, stressed), squares = 0.0;
    for (std::size_t p = 0; p < theta.size(); ++p)
        if (!bodies.force()[p].empty()) energy -= theta[p] * dot(bodies.force()[p], u);
    const SparseMatrix& k = bodies.stiffness();
    for (std::size_t i = 0; i < u.size(); ++i) {
        double sum = 0.0;
        for (std::int64_t e = k.start[i]; e < k.start[i + 1]; ++e)
            sum += std::abs(k.value[index(e)] * u[index(k.column[index(e)])]);
        squares += u[i] * u[i] * sum * sum;
    }
    return std::numeric_limits<double>::epsilon() * std::sqrt(squares) / std::abs(energy);
}

}  // namespace delam
