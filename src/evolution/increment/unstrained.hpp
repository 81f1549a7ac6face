// SPDX-License-Identifier: BSD-3-Clause
// States in which nothing is strained: bodies that have come apart, or have not met yet.
#pragma once

#include "evolution/contact/contact.hpp"
#include "evolution/increment/state.hpp"
#include "reduction/operator/jump_operator.hpp"
#include "scene/problem.hpp"

namespace delam {

// Sets the energies and forces of such a state to 0: what a solve leaves there is rounding. Other states stay as they
// are.
void drop_rounding(const Problem& problem, const JumpOperator& op, const ContactScene& contact, State& state);

}  // namespace delam
