// SPDX-License-Identifier: BSD-3-Clause
// Steps in which the load falls although its factor grows and no jump was recorded, from the rows of history.csv.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "result/history/jumps.hpp"
#include "result/history/rows.hpp"

namespace cli {

struct LoadDrops {
    std::vector<std::int64_t> steps;
    // The largest, relative to the largest reaction before it.
    std::int64_t step = 0;
    double time = 0;
    std::string column;
    double from = 0;
    double to = 0;
};

// A drop: |reaction| of a pattern falls by more than 2 % of its largest value so far while |factor| of that pattern
// grows, in a step without a jump in which no body buckles. Falls under a factor that shrinks or rests, while other
// loads change, say nothing.
LoadDrops load_drops_of(const Rows& rows, const std::vector<Jump>& jumps, const Scene& scene);
// "" if there is none.
std::string load_drops_line(const LoadDrops& drops);

}  // namespace cli
