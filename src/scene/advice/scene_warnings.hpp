// SPDX-License-Identifier: BSD-3-Clause
// Warns, before anything is solved, of what makes the results of a scene doubtful: faces that lie on each other without
// an interface, an interface whose law finds no adhesion, a mesh that does not resolve the process zone, a law that
// hardly softens, a jump at debonding that is longer than a body is thick.
#pragma once

#include "base/monitor.hpp"
#include "scene/problem.hpp"

namespace delam {

// Tells the host (log level 1) of each, with the interfaces that have it.
void warn_of_scene(const Problem& problem, const Monitor& monitor);

}  // namespace delam
