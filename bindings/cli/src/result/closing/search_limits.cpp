// SPDX-License-Identifier: BSD-3-Clause
#include "result/closing/search_limits.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scene/units/labels.hpp"
#include "text/say.hpp"

namespace cli {

namespace {

constexpr double margin_rounding = 1e-9;  // of energy or work
constexpr double least_share = 1e-6;      // of energy or work: smaller bounds are not worth a line

}  // namespace

SearchLimits search_limits_of(const Rows& rows, double tolerance) {
    SearchLimits out;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const Row& row = rows[i];
        const auto step = static_cast<std::int64_t>(number_of(row, "step"));
        const double scale = energy_scale(row), gap = number_of(row, "search_gap"),
                     margin = number_of(row, "search_margin");
        if (gap > tolerance * scale) {
            out.gap_steps.push_back(step);
            if (gap > out.gap) {
                out.gap_step = step;
                out.gap_time = number_of(row, "time");
                out.gap = gap;
                out.gap_allowed = tolerance * scale;
            }
        } else if (gap > out.bound_share * scale) {
            out.bound_step = step;
            out.bound_time = number_of(row, "time");
            out.bound = gap;
            out.bound_share = gap / scale;
        }
        if (margin < -margin_rounding * scale) {
            out.margin_steps.push_back(step);
            if (margin < out.margin) {
                out.margin_step = step;
                out.margin_time = number_of(row, "time");
                out.margin = margin;
            }
        }
    }
    return out;
}

std::vector<std::string> search_lines(const SearchLimits& limits, const Scene& scene, double work) {
    std::vector<std::string> out;
    const auto in_steps = [](const std::vector<std::int64_t>& steps) {
        return counted(static_cast<std::int64_t>(steps.size()), "step");
    };
    if (!limits.gap_steps.empty() && std::isinf(limits.gap))
        out.push_back(
            fmt::format("warning: search: in {} (the first is step {}) it has no bound on the energy of the "
                        "states that it left out (search_gap is infinite)",
                        in_steps(limits.gap_steps), limits.gap_steps.front()));
    else if (!limits.gap_steps.empty())
        out.push_back(
            fmt::format("warning: search: in {} a state that it left out may have less energy than the one "
                        "kept, by up to {} ({}; search_tolerance allows {})",
                        in_steps(limits.gap_steps), energy_text(limits.gap, scene, work),
                        instant_text(limits.gap_step, limits.gap_time), energy_text(limits.gap_allowed, scene, work)));
    else if (limits.bound_share > least_share)
        out.push_back(fmt::format(
            "search: no position of a front, with the other fronts in their places, has less energy than the "
            "state kept by more than {} ({:.2g} % of the energy; {})",
            energy_text(limits.bound, scene, work), 100.0 * limits.bound_share,
            instant_text(limits.bound_step, limits.bound_time)));
    if (!limits.margin_steps.empty())
        out.push_back(
            fmt::format("warning: search: in {} a state of lower energy was seen and not kept, lower by up "
                        "to {} ({})",
                        in_steps(limits.margin_steps), energy_text(-limits.margin, scene, work),
                        instant_text(limits.margin_step, limits.margin_time)));
    return out;
}

}  // namespace cli
