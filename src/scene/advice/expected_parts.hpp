// SPDX-License-Identifier: BSD-3-Clause
// Predicts how many minimisations an analysis takes, before anything is solved.
#pragma once

#include "scene/problem.hpp"

namespace delam {

// Returns how many rows of pairs on a front a part of mixed mode may dissipate: the smaller the option path_step, the
// fewer, so that a zone of few pairs is followed as finely as one of many.
double pairs_of_part(double path_step);

// Returns by how much a part of mixed mode may advance a front, in the measure of `row`, which a row of pairs along the
// front has, and of `zone`, its process zone.
double advance_of_part(double path_step, double row, double zone);

// Nobody knows beforehand how much of the interfaces breaks; predictions assume this share of the pairs that adhere.
// (verify/bench/predictions.py: fourteen examples are predicted .33 to 2.6 times their alternations with it. Half and
// twice of the share are half and twice of the parts in which cracks grow.)
inline constexpr double expected_share = 0.5;

// Minimisations of an analysis.
struct ExpectedParts {
    double per_step = 2.0;  // in a step, whether anything grows or not
    double growth = 0.0;    // more in all steps together: parts in which cracks grow
};
// followed: steps are followed along their load.
ExpectedParts expected_parts(const Problem& problem, bool followed, double path_step);

}  // namespace delam
