// SPDX-License-Identifier: BSD-3-Clause
#include "result/closing/estimate.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace cli {

namespace {

constexpr double rounding = 1e-9;  // of the larger of energy and work

}  // namespace

std::vector<std::int64_t> violated_steps(const Rows& rows, double eta) {
    std::vector<std::int64_t> out;
    // Row 0 is the initial state, which is not the result of a step.
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const auto of = [&row = rows[i]](const char* column) { return number_of(row, column); };
        const double slack = eta * energy_scale(rows[i]);
        // Negated, so that NaN counts as violated.
        if (!(of("lower") - of("increment") <= slack && of("increment") - of("upper") <= slack))
            out.push_back(static_cast<std::int64_t>(of("step")));
    }
    return out;
}

std::string estimate_line(const std::vector<std::int64_t>& steps, double eta) {
    if (steps.empty()) return "";
    return fmt::format("two-sided estimate violated in steps: {} (tolerance eta = {:g})", fmt::join(steps, ", "), eta);
}

std::vector<std::int64_t> inconclusive_steps(const Rows& rows) {
    std::vector<std::int64_t> out;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const double work = std::abs(number_of(rows[i], "work") - number_of(rows[i - 1], "work"));
        const double band = number_of(rows[i], "upper") - number_of(rows[i], "lower");
        if (band > std::max(work, rounding * energy_scale(rows[i])))
            out.push_back(static_cast<std::int64_t>(number_of(rows[i], "step")));
    }
    return out;
}

std::string inconclusive_line(const std::vector<std::int64_t>& steps) {
    if (steps.empty()) return "";
    return fmt::format(
        "two-sided estimate says nothing in {} {} (the first is step {}): its bounds lie farther apart than the work "
        "of "
        "the step",
        steps.size(), steps.size() == 1 ? "step" : "steps", steps.front());
}

}  // namespace cli
