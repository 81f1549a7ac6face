// SPDX-License-Identifier: BSD-3-Clause
// Checks whether the callbacks of a host law derive from one energy.
#pragma once

#include "law/softening/host_softening.hpp"

namespace delam {

// Samples mixity, adhesion and driving energy, and checks that g(B, 1) = 0, g is decreasing and convex, its derivatives
// are those returned, zeta*(B, Y) is nonincreasing in Y and the minimiser of zeta Y + g, and its slope is the one
// returned. Throws Error(DELAM_ERROR_PROBLEM) naming the law, the fault, the place and the values.
void require_consistent(const HostSoftening& law);

}  // namespace delam
