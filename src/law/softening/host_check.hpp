// SPDX-License-Identifier: BSD-3-Clause
// Checks whether the callbacks of a host law derive from one energy.
#pragma once

#include "law/softening/host_softening.hpp"

namespace delam {

// Samples mixity, adhesion and driving energy. Checks that g(B, 1) = 0, that g is decreasing and convex, and that its
// derivatives are those returned; that zeta*(B, Y) does not increase with Y, that it minimises zeta Y + g, and that its
// slope is the one returned. Throws Error(DELAM_ERROR_PROBLEM) naming the law, the fault, the place and the values.
void require_consistent(const HostSoftening& law);

}  // namespace delam
