// SPDX-License-Identifier: BSD-3-Clause
#include "scene/advice/expected_parts.hpp"

#include <algorithm>
#include <cmath>

#include "base/numbers.hpp"
#include "scene/advice/process_zone.hpp"

namespace delam {

namespace {

// Pairs on a front that a part dissipates, over path_step, and at most: where the process zone has few pairs, this is
// the accuracy of a path, and goes with the option. (Measured by verify/bench/constants.py with
// verify/bench/analyses.py: in five whole steps of mixed mode, half moves the dissipated energy by 0.9 % and the work
// by 3.5 % at most, with up to twice the solves; twice by 1.0 % and 5 %, with 0.4 times as many. The test
// few_pairs_follow_path_step shows what path_step does.)
constexpr double pairs_per_path_step = 5.0, most_pairs_of_part = 0.5;

}  // namespace

double pairs_of_part(double path_step) { return std::min(most_pairs_of_part, pairs_per_path_step * path_step); }

double advance_of_part(double path_step, double row, double zone) {
    return std::max(pairs_of_part(path_step) * row, path_step * zone);
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
