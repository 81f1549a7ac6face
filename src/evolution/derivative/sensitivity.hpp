// SPDX-License-Identifier: BSD-3-Clause
// Derivatives of an analysis by parameters of the laws, followed step by step, and of a step in parts by its loads.
//
// At the end of a step the bodies and springs are at rest, and each pair that damages satisfies Y(j) = D(B, zeta)
// (step_tangent.hpp), with D(B, S, zeta) where the law has two toughnesses in shear. Both depend on a parameter p by
// the stiffness and the toughness of the law. With dzeta given for the pairs that do not damage (as before the step; 0
// if debonded), the forces of the springs change at fixed jumps by
//
//   F = w zeta dk j + sum over pairs at rest of v dzeta
//
// and the jumps by  dj = J dtheta - (answer to F) - U dzeta.  For the pairs that damage
//
//   own dzeta = omega . dj + r,     r = d(Y - D)/dp at fixed jump and adhesion
//
// which is the system of the step tangent with another right-hand side: one solve for each parameter beside one for
// each damaging pair. They are the derivatives of the analysis as long as no pair, contact or jump changes its branch.
// Source: the direct differentiation method, P. Michaleris, D. Tortorelli, C. Vidal, Int. J. Numer. Meth. Engng 37
// (1994) 2471-2499.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "evolution/derivative/step_tangent.hpp"
#include "evolution/increment/rule/step_rule.hpp"
#include "scene/problem.hpp"

namespace delam {

// A number of the laws of some interfaces, changed in all of them together, or a factor of the loads.
struct FollowedParameter {
    std::vector<Law> more, less;    // the laws with a slightly larger and a smaller value
    double difference = 0.0;        // between their values
    std::vector<std::int64_t> law;  // [pairs] index into more and less; -1: not concerned
    std::vector<double> load;       // [patterns] derivative of the load factors; empty: 0
};

// The parameter of these interfaces. Error(DELAM_ERROR_ARGUMENT): an interface has no law, its law has no such number
// or a value of 0, or values that differ from those of the others; DELAM_ERROR_STATE: a law has a gradient term.
FollowedParameter followed_parameter(const Problem& problem, std::span<const std::int64_t> interfaces,
                                     const std::string& key);

// Returns the load factors as parameters: a change of one at the end of a step changes the loads by this share of it.
std::vector<FollowedParameter> followed_loads(std::size_t patterns, std::size_t pairs, double share);
// Returns the derivatives of the conjugates by all load factors, [patterns][patterns], a row for each conjugate.
std::vector<double> by_loads(const Sensitivity& by, std::size_t patterns);

// Returns the derivatives of the state that the tangent has been made for. step: the increment that ended in it; null:
// it is elastic, without any damage since the initial state. begun: derivatives with those of the mixities with which
// the step began; null: they are those of the state before.
Sensitivity sensitivity(Linearised linearised, std::span<const FollowedParameter> parameters,
                        std::span<const Pattern> patterns, const StepRule* step, const Sensitivity* begun = nullptr);

}  // namespace delam
