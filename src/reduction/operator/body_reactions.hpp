// SPDX-License-Identifier: BSD-3-Clause
// The forces with which the constraints act on the bodies, and what is left of equilibrium with them.
#pragma once

#include <span>
#include <vector>

#include "reduction/operator/body_system.hpp"

namespace delam {

// Returns the forces of the constraints. stressed: K u; force: of the jump rows.
std::vector<double> body_reactions(const BodySystem& bodies, std::span<const double> theta,
                                   std::span<const double> stressed, std::span<const double> force);

// Returns the largest unbalanced force, F.
double equilibrium_defect(const BodySystem& bodies, std::span<const double> theta, std::span<const double> stressed,
                          std::span<const double> force);

}  // namespace delam
