// SPDX-License-Identifier: BSD-3-Clause
// Reports what the search of an energetic analysis left open, from the columns search_gap and search_margin.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "result/history/rows.hpp"
#include "scene/scene.hpp"

namespace cli {

struct SearchLimits {
    std::vector<std::int64_t> gap_steps;  // steps whose gap exceeds what search_tolerance allows
    std::int64_t gap_step = 0;            // the largest of them
    double gap_time = 0;
    double gap = 0;               // infinite: the search has no bound
    double gap_allowed = 0;       // in that step
    std::int64_t bound_step = 0;  // the largest gap over the energy of its step, where it is allowed
    double bound_time = 0;
    double bound = 0;
    double bound_share = 0;
    std::vector<std::int64_t> margin_steps;  // steps in which a state of lower energy was seen and not kept
    std::int64_t margin_step = 0;            // the largest of them
    double margin_time = 0;
    double margin = 0;  // < 0: the energy of that state less that of the state kept
};

// tolerance: option search_tolerance.
SearchLimits search_limits_of(const Rows& rows, double tolerance);
std::vector<std::string> search_lines(const SearchLimits& limits, const Scene& scene, double work);

}  // namespace cli
