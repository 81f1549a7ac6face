// SPDX-License-Identifier: BSD-3-Clause
// Is what was found in equilibrium? Rounding can take all digits of a stiffness that is a small difference of large
// ones (plies thousands of times longer than thick), and neither minimisation nor its tolerances would notice.
#pragma once

#include "evolution/increment/state.hpp"
#include "reduction/jump_operator.hpp"
#include "scene/problem.hpp"

namespace delam {

// Of the largest reaction, or force_floor (F) where that is larger:
inline constexpr double poor_balance = 1e-6;  // worth a word
inline constexpr double no_balance = 1e-3;    // nothing to go by

// F: of the device, or force_floor where that is larger (stresses of eigenstrains may need no reactions).
double largest_reaction(const JumpOperator& op, const State& state, double force_floor);

// Largest force that no force balances, over the largest reaction; 0 where the operator's estimate sees no reason to
// look, which costs nothing.
double out_of_balance(const Problem& problem, const JumpOperator& op, const State& state, double force_floor);

}  // namespace delam
