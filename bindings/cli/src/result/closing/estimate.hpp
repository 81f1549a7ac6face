// SPDX-License-Identifier: BSD-3-Clause
// Checks the two-sided energy estimate in the rows of history.csv, so that a resumed run includes the steps before it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "result/history/rows.hpp"

namespace cli {

// Steps in which lower - increment or increment - upper exceeds eta * max(|stored energy|, |work|), eta being
// the option backtracking_tolerance.
std::vector<std::int64_t> violated_steps(const Rows& rows, double eta);
// The closing line; "" if the estimate holds in every step.
std::string estimate_line(const std::vector<std::int64_t>& steps, double eta);

// Steps whose bounds lie farther apart than the work of the step: the estimate holds there whatever happens.
std::vector<std::int64_t> inconclusive_steps(const Rows& rows);
// The closing line; "" if there is none.
std::string inconclusive_line(const std::vector<std::int64_t>& steps);

}  // namespace cli
