// SPDX-License-Identifier: BSD-3-Clause
// Checks the two-sided energy estimate in the rows of history.csv, so that a resumed run includes the steps before it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scene.hpp"

namespace cli {

// Option backtracking_tolerance (eta), set or not.
double estimate_tolerance(const Scene& scene);
// Steps in which lower - increment_lower or increment - upper exceeds eta * max(|stored energy|, |work|).
std::vector<std::int64_t> violated_steps(std::string_view history, double eta);
// The closing line, with its end of line; "" if the estimate holds in every step.
std::string estimate_line(const std::vector<std::int64_t>& steps, double eta);

}  // namespace cli
