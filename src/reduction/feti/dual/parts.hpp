// SPDX-License-Identifier: BSD-3-Clause
// The scene cut into subdomains and condensed: each onto the DOFs that multipliers touch.
#pragma once

#include <cstdint>
#include <vector>

#include "base/monitor.hpp"
#include "reduction/feti/dual/dual_rows.hpp"
#include "scene/problem.hpp"

namespace delam {

// Returns the number of subdomains into which the scene is cut: that of the options, or one chosen by size.
std::int64_t feti_subdomains(const Problem& problem);

struct FetiParts {
    std::vector<Subdomain> subdomains;  // those that the host condenses come after the others, control nodes last
    std::vector<std::vector<std::int64_t>> cells;  // of each subdomain; none where the host gives the stiffness
    std::vector<std::vector<NodeCopy>> copies;     // of each mesh node
    DualRows rows;
};

FetiParts make_parts(const Problem& problem, Monitor& monitor);

}  // namespace delam
