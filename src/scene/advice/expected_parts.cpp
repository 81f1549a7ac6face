// SPDX-License-Identifier: BSD-3-Clause
#include "scene/advice/expected_parts.hpp"

#include <algorithm>
#include <cmath>

#include "base/numbers.hpp"
#include "scene/advice/process_zone.hpp"

namespace delam {

namespace {

// Rows of pairs on a front that a part of mixed mode dissipates, over path_step, and at most.
constexpr double pairs_of_part = 5.0, most_pairs_of_part = 0.5;

}  // namespace

double advance_of_part(double path_step, double row, double zone) {
    return std::max(std::min(most_pairs_of_part, pairs_of_part * path_step) * row, path_step * zone);
}

// A step that is taken whole needs about two alternations: 76, 89 and 108 were counted in the 40 steps of the examples
// enf-ductile, mmf-ductile and laminate-dcb. One that is followed begins with one, and adds one for each part.
ExpectedParts expected_parts(const Problem& problem, bool followed, double path_step) {
    ExpectedParts parts;
    if (!followed) return parts;
    parts.per_step = 1.0;
    for (std::size_t i = 0; i < problem.interfaces.size(); ++i) {
        const ProcessZone zone = predicted_process_zone(problem, static_cast<std::int64_t>(i));
        if (!(zone.length > 0.0 && zone.spacing > 0.0)) continue;
        const std::vector<double>& adhesion = problem.interfaces[i].adhesion;
        const auto adhering =
            static_cast<double>(std::count_if(adhesion.begin(), adhesion.end(), [](double z) { return z > 0.0; }));
        const double rows = problem.mesh->dimension() == 2 ? adhering : std::sqrt(adhering);
        parts.growth += expected_share * rows / advance_of_part(path_step, 1.0, zone.length / zone.spacing);
    }
    return parts;
}

}  // namespace delam
