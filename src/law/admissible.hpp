// SPDX-License-Identifier: BSD-3-Clause
// Gc(B) >= Go(B) at every mixity: without it no softening branch joins onset and end.
#pragma once

#include "law/law.hpp"

namespace delam {

// Throws Error(DELAM_ERROR_PROBLEM) naming the pure mode, or the mixity in between, where Gc < Go. Parameters > 0.
void require_admissible(const Law& law);
// Throws Error(DELAM_ERROR_PROBLEM) naming the parameter, its value and range, or the mixity where Gc(B) < Go(B),
// or where the callbacks of the host contradict each other.
void validate(const Law& law);

}  // namespace delam
