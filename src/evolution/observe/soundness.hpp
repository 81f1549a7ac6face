// SPDX-License-Identifier: BSD-3-Clause
// Checks every state before a call returns it, whatever has computed it: it must be finite, and held by its supports.
#pragma once

#include "evolution/increment/state.hpp"
#include "scene/problem.hpp"

namespace delam {

// Throws Error(DELAM_ERROR_NUMERICAL) with what is not finite or which support is violated by how much. converged: a
// state that is not converged may miss its supports, but is finite.
void require_sound(const Problem& problem, const State& state, bool converged);

}  // namespace delam
