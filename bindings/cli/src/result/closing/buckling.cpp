// SPDX-License-Identifier: BSD-3-Clause
#include "result/closing/buckling.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "result/history/history.hpp"
#include "scene/units/labels.hpp"
#include "text/say.hpp"

namespace cli {

std::vector<BuckledStep> buckled_steps(const Rows& rows, const Scene& scene) {
    std::vector<BuckledStep> out;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const Row &before = rows[i - 1], &after = rows[i];
        const auto modes = static_cast<std::int64_t>(number_of(after, "buckling_modes"));
        if (modes == 0) continue;
        BuckledStep step{static_cast<std::int64_t>(number_of(after, "step")), modes, number_of(after, "buckling_time"),
                         0, number_of(after, "buckling_released")};
        const double begin = number_of(before, "time"), end = number_of(after, "time");
        const std::string title = scene.patterns.empty() ? "load" : load_title(scene, 0);
        const double from = number_of(before, title), to = number_of(after, title);
        step.load = end > begin ? from + (to - from) * (step.time - begin) / (end - begin) : to;
        out.push_back(step);
    }
    return out;
}

std::string buckling_line(const std::vector<BuckledStep>& steps, const Scene& scene, double work) {
    if (steps.empty()) return "";
    const BuckledStep& first = steps.front();
    const std::string freed =
        first.released > 0 ? " and snap through, which releases " + energy_text(first.released, scene, work) : "";
    const std::string more =
        steps.size() > 1
            ? fmt::format("; later again in {}", counted(static_cast<std::int64_t>(steps.size()) - 1, "step"))
            : "";
    return fmt::format("the bodies buckle in step {}, at a load factor of {:.4g}{}{}: the state that follows is stable",
                       first.step, first.load, freed, more);
}

}  // namespace cli
