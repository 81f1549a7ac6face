// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/increment/unstrained.hpp"

#include <algorithm>

#include "base/numbers.hpp"
#include "evolution/contact/active_set.hpp"
#include "scene/pieces.hpp"

namespace delam {

// Bodies that nothing touches and that move without strain store nothing and have no reactions. Eigenstrains and dead
// forces strain bodies whatever their displacements.
void drop_rounding(const Problem& problem, const JumpOperator& op, const ContactScene& contact, State& state) {
    Response& response = state.response;
    const double rounding = contact.rounding_of_forces(state.theta, response.jump);
    const auto pushes = [&](const NodalForce& force) { return force.value * state.theta[index(force.pattern)] != 0.0; };
    // A force on a node that a support holds does no work, but the support carries it.
    if (!problem.eigenstrains.empty() || std::any_of(problem.forces.begin(), problem.forces.end(), pushes) ||
        max_abs(response.force) > rounding ||
        !without_strain(problem, op.displacement(state.theta, response),
                        force_rounding * contact.prescribed_size(state.theta)))
        return;
    response.stored_bulk = 0.0;
    std::fill(response.force.begin(), response.force.end(), 0.0);
    for (std::size_t p = 0; p < response.conjugate.size(); ++p)
        if (problem.patterns[p].drives != Pattern::Drives::force) response.conjugate[p] = 0.0;
}

}  // namespace delam
