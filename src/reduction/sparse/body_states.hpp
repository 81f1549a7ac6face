// SPDX-License-Identifier: BSD-3-Clause
// Displacements and energies of a state of the bodies, given by their variables x (jump_variables.hpp) at the load
// factors theta.
#pragma once

#include <span>
#include <vector>

#include "reduction/operator/body_system.hpp"
#include "reduction/sparse/body_solver.hpp"

namespace delam {

// Returns the displacements U theta + T x and, in `stressed`, K times them.
void recover_state(const BodySystem& bodies, std::span<const double> theta, std::span<const double> x,
                   std::vector<double>& displacement, std::vector<double>& stressed);
BodySolver::Work work_of_state(const BodySystem& bodies, std::span<const double> theta, std::span<const double> x);
// Returns the rounding of the energy as a part of it: each component of K u has an error of the size of its terms, with
// a random sign.
double energy_rounding_of_state(const BodySystem& bodies, std::span<const double> theta, std::span<const double> x);

}  // namespace delam
