// SPDX-License-Identifier: BSD-3-Clause
#include "result/closing/load_drops.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "result/history/history.hpp"
#include "scene/units/labels.hpp"
#include "text/say.hpp"

namespace cli {

namespace {

constexpr double told_drop = 0.02;  // of the largest reaction so far

}  // namespace

LoadDrops load_drops_of(const Rows& rows, const std::vector<Jump>& jumps, const Scene& scene) {
    std::set<std::int64_t> jumped;
    for (const Jump& jump : jumps) jumped.insert(jump.step);
    std::vector<double> largest(scene.patterns.size(), 0.0);
    LoadDrops out;
    double most = 0.0;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const auto step = static_cast<std::int64_t>(number_of(rows[i], "step"));
        if (number_of(rows[i], "buckling_modes") > 0.0) jumped.insert(step);
        bool dropped = false;
        for (std::size_t p = 0; p < scene.patterns.size(); ++p) {
            const std::string load = load_title(scene, p), reaction = reaction_title(scene, p);
            const double from = number_of(rows[i - 1], reaction), to = number_of(rows[i], reaction);
            largest[p] = std::max(largest[p], std::abs(from));
            const bool grows = std::abs(number_of(rows[i], load)) > std::abs(number_of(rows[i - 1], load));
            const double fall = std::abs(from) - std::abs(to);
            if (!grows || !(fall > told_drop * largest[p]) || jumped.contains(step)) continue;
            dropped = true;
            if (!(fall / largest[p] > most)) continue;
            most = fall / largest[p];
            out.step = step;
            out.time = number_of(rows[i], "time");
            out.column = reaction;
            out.from = from;
            out.to = to;
        }
        if (dropped) out.steps.push_back(step);
    }
    return out;
}

std::string load_drops_line(const LoadDrops& drops) {
    if (drops.steps.empty()) return "";
    return fmt::format(
        "load drops without a recorded jump: in {} the {} falls by more than {} of its largest value; "
        "most in {}, from {:.4g} to {:.4g}; smaller steps tell a steady fall from a jump",
        counted(static_cast<std::int64_t>(drops.steps.size()), "step"), drops.column, percent_text(told_drop),
        instant_text(drops.step, drops.time), drops.from, drops.to);
}

}  // namespace cli
