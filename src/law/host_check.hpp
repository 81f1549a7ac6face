// SPDX-License-Identifier: BSD-3-Clause
// Do the callbacks of a law that the host gives belong to one energy?
#pragma once

#include "law/host_softening.hpp"

namespace delam {

// Samples mixity, adhesion and driving energy: g(B, 1) = 0, g decreasing and convex, its derivatives those of g,
// zeta*(B, Y) nonincreasing in Y and the minimiser of zeta Y + g, its slope its own. Throws Error(DELAM_ERROR_PROBLEM)
// naming the law, what is wrong, the place and the values.
void require_consistent(const HostSoftening& law);

}  // namespace delam
