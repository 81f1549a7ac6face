// SPDX-License-Identifier: BSD-3-Clause
// The motions that the supports leave free: rigid motions of the structure that no constraint and no tie resists.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scene/problem.hpp"

namespace delam {

struct FreeMotion {
    std::vector<std::int32_t> bodies;    // indices of the bodies that move
    std::vector<std::int64_t> controls;  // control nodes that move
    std::string description;             // "translate along x", "rotate about the point (0.06, 0.003)"
    double force_work;  // largest |work| of a pattern's dead forces on this motion, over force times length; 0: none
    std::int64_t force_pattern;  // the pattern of that work, -1: none
};

// tied: all interfaces count as bonded, including notches. Otherwise only bonded interfaces and pairs with adhesion > 0
// do, and interfaces with contact alone (delam_problem_set_contact) hold their normals, whether a load presses or
// lifts.
std::vector<FreeMotion> free_motions(const Problem& problem, bool tied);

}  // namespace delam
