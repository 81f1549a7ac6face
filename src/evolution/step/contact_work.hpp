// SPDX-License-Identifier: BSD-3-Clause
// The work of the reactions along a step in which contact alone changes: they then do not follow the load linearly.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "evolution/minimise/minimise.hpp"

namespace delam {

// Returns the integral of q . d over the way s from 0 to 1, by the trapezoidal rule. Parts are halved where that
// changes the integral most. It ends within `tolerance` of `energy` (both F L), or after `most` values of q.
//   d: change of the factors; first, last: q at both ends; at(s): q in between; [patterns] each
double work_along(std::span<const double> d, std::span<const double> first, std::span<const double> last,
                  const std::function<std::vector<double>(double)>& at, double energy, double tolerance,
                  std::int64_t most);

// Integrates the work of a step that damages nothing and changes the contact set, if the trapezoidal rule over the
// whole step misses it: all states in between are known. Their solves count as effort of the step.
void integrate_work(const Minimiser& minimiser, const StepRule& step, State& next);

}  // namespace delam
