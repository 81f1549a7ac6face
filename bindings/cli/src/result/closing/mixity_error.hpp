// SPDX-License-Identifier: BSD-3-Clause
// The largest error of a step's dissipated energy that its mode mixities cause (column mixity_error).
#pragma once

#include <cstdint>
#include <string>

#include "result/history/rows.hpp"
#include "scene/scene.hpp"

namespace cli {

struct MixityError {
    std::int64_t step = 0;
    double time = 0;
    double relative = 0;    // to what the step dissipates
    double dissipated = 0;  // in that step
};

MixityError mixity_error_of(const Rows& rows);
// "" if the error is below 1 %.
std::string mixity_error_line(const MixityError& error, const Scene& scene, double work);

}  // namespace cli
