// SPDX-License-Identifier: BSD-3-Clause
// Tells where the bodies of an analysis have buckled, from the rows of history.csv.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "result/history/rows.hpp"
#include "scene/scene.hpp"

namespace cli {

struct BuckledStep {
    std::int64_t step = 0;
    std::int64_t modes = 0;  // that the step has followed
    double time = 0;         // at which the bodies began to buckle
    double load = 0;         // factor of the first pattern then
    double released = 0;     // energy, where they snap through
};

std::vector<BuckledStep> buckled_steps(const Rows& rows, const Scene& scene);
// One line for all of them; empty: there are none.
std::string buckling_line(const std::vector<BuckledStep>& steps, const Scene& scene, double work);

}  // namespace cli
