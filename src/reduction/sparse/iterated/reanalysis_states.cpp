// SPDX-License-Identifier: BSD-3-Clause
// Energies and fields of a state of the reanalysis.
#include <cmath>
#include <limits>

#include "base/numbers.hpp"
#include "linalg/dense/dense.hpp"
#include "reduction/sparse/iterated/reanalysis.hpp"

namespace delam {

double Reanalysis::load_size(std::span<const double> theta) const { return max_abs(load(theta)); }

void Reanalysis::recover(std::span<const double> theta, std::span<const double> x, std::vector<double>& displacement,
                         std::vector<double>& stressed) {
    displacement = bodies_.lift(theta);
    bodies_.add_variables(x, displacement);
    stressed = bodies_.stressed(displacement);
}

BodySolver::Work Reanalysis::work(std::span<const double> theta, std::span<const double> x) {
    std::vector<double> u, stressed;
    recover(theta, x, u, stressed);
    Work work;
    work.strain = 0.5 * dot(u, stressed);
    const std::vector<std::vector<double>>& force = bodies_.force();
    for (std::size_t p = 0; p < theta.size(); ++p)
        if (!force[p].empty() && theta[p] != 0.0) add_scaled(-theta[p], force[p], stressed);
    for (std::size_t p = 0; p < theta.size(); ++p) {
        work.lifted.push_back(dot(bodies_.variables().lift[p], stressed));
        work.done.push_back(force[p].empty() ? 0.0 : dot(force[p], u));
    }
    return work;
}

// Each component of K u has an error of the size of its terms, with a random sign.
double Reanalysis::energy_rounding(std::span<const double> theta, std::span<const double> x) {
    std::vector<double> u, stressed;
    recover(theta, x, u, stressed);
    double energy = 0.5 * dot(u, stressed), squares = 0.0;
    for (std::size_t p = 0; p < theta.size(); ++p)
        if (!bodies_.force()[p].empty()) energy -= theta[p] * dot(bodies_.force()[p], u);
    const SparseMatrix& k = bodies_.stiffness();
    for (std::size_t i = 0; i < u.size(); ++i) {
        double sum = 0.0;
        for (std::int64_t e = k.start[i]; e < k.start[i + 1]; ++e)
            sum += std::abs(k.value[index(e)] * u[index(k.column[index(e)])]);
        squares += u[i] * u[i] * sum * sum;
    }
    return std::numeric_limits<double>::epsilon() * std::sqrt(squares) / std::abs(energy);
}

}  // namespace delam
