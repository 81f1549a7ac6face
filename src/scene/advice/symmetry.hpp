// SPDX-License-Identifier: BSD-3-Clause
// Symmetries of a scene: reflections and half-turns that map its mesh, materials, laws, initial adhesion, gaps,
// supports and loads onto themselves. A quasi-static evolution need not keep them: where two equal cracks compete, one
// of them may grow first, and the mirrored evolution is as good.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/problem.hpp"

namespace delam {

struct Symmetry {
    std::string name;
    std::vector<std::int64_t> image;  // [pairs] the pair that each becomes
};

// Returns the symmetries that take some pair to another one; none of scenes with a stiffness of the host or with an
// engine, whose insides are unknown.
std::vector<Symmetry> symmetries(const Problem& problem);

}  // namespace delam
