// SPDX-License-Identifier: BSD-3-Clause
// Reads what a scene says about its pairs: their laws, their contact, and the parts that they may leave free.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "evolution/contact/contact.hpp"
#include "evolution/increment/damage_step.hpp"
#include "evolution/increment/state.hpp"
#include "scene/problem.hpp"

namespace delam {

PairLaws pair_laws(const Problem& problem);

// Returns the gradient terms of the interfaces whose law has kappa > 0.
std::vector<std::shared_ptr<const GradientTerm>> gradient_terms(const Problem& problem);

// parts must outlive the result, whose row_stiffness and carried_force are not set.
ContactScene contact_scene(const Problem& problem, const FreeParts& parts);

// Returns ContactScene::carried_force of one pattern, whose bonded response this is: its displacements times the
// stiffness of the rows there, its dead forces, and the forces that close its gaps. Where no part may float, only gaps
// count.
double carried_force(const Problem& problem, const JumpOperator& op, const ContactScene& contact,
                     std::span<const double> theta, const Response& response);

// Returns State::free_since of a state that follows another.
std::vector<std::int64_t> free_since(const JumpOperator& op, const ContactScene& contact, const PairLaws& pairs,
                                     const State& next, const State& before);

}  // namespace delam
