// SPDX-License-Identifier: BSD-3-Clause
// Loads in proportion, to which bodies, springs and frictionless contact answer with displacements in proportion.
#pragma once

#include <optional>
#include <span>

#include "evolution/contact/contact.hpp"
#include "evolution/increment/damage_step.hpp"
#include "evolution/increment/state.hpp"
#include "reduction/operator/jump_operator.hpp"

namespace delam {

// Returns a of before = a next, a > 0; none: the loads change their shares, or one is zero.
std::optional<double> load_ratio(std::span<const double> before, std::span<const double> next);

// Sets the response of `next`, whose adhesion is that before, from that of the state before. False: it is not known
// without a solve.
bool displaced_in_proportion(const JumpOperator& op, const PairLaws& pairs, const ContactScene& contact, State& next,
                             const State& before);

}  // namespace delam
