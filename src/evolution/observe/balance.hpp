// SPDX-License-Identifier: BSD-3-Clause
// Checks whether a state is in equilibrium. Rounding can destroy all digits of a stiffness that is a small difference
// of large ones (plies thousands of times longer than thick). Minimisation and its tolerances would not notice.
#pragma once

#include "evolution/increment/state.hpp"
#include "reduction/operator/jump_operator.hpp"
#include "scene/problem.hpp"

namespace delam {

// Relative to the largest reaction, or to force_floor (F) if that is larger:
inline constexpr double poor_balance = 1e-6;  // worth a warning
inline constexpr double no_balance = 1e-3;    // the state is useless

// F: largest reaction, or force_floor where that is larger (stresses of eigenstrains may need no reactions).
double largest_reaction(const JumpOperator& op, const State& state, double force_floor);

// True if these displacements [mesh DOFs] are rigid motions of all pieces, but for rounding: their forces are rounding.
bool without_strain(const Problem& problem, std::span<const double> displacement);

// Largest unbalanced force over the largest reaction; 0 if the operator's estimate gives no reason to compute it, which
// takes no time.
double out_of_balance(const Problem& problem, const JumpOperator& op, const State& state, double force_floor);

}  // namespace delam
