// SPDX-License-Identifier: BSD-3-Clause
// Warns of doubtful scenes before anything is solved: of faces that lie on each other without an interface, of faces of
// an interface that overlap, of laws without adhesion to act on, and of laws that hardly soften. It also warns of a
// mesh that does not resolve the process zone, and of a jump at debonding that is longer than a body is thick.
#pragma once

#include "base/monitor.hpp"
#include "scene/problem.hpp"

namespace delam {

// Tells the host (log level 1) of each, with the interfaces that have it.
void warn_of_scene(const Problem& problem, const Monitor& monitor);

}  // namespace delam
