// SPDX-License-Identifier: BSD-3-Clause
#include "scene/labels.hpp"

#include <fmt/format.h>

namespace cli {

namespace {

std::string with_unit(double number, const std::string& unit) {
    return fmt::format("{:.3g}{}{}", number, unit.empty() ? "" : " ", unit);
}

}  // namespace

std::string energy_text(double energy, const Scene& scene) {
    const std::string &force = scene.units.force, &length = scene.units.length;
    if (force.empty() || length.empty()) return with_unit(energy, "");
    const std::string work = force == "N" && length == "m" ? "J" : force + " " + length;
    return with_unit(energy, scene.geometry.dimension == 2 ? work + "/" + length : work);
}

std::string extent_text(double extent, const Scene& scene) {
    const std::string& length = scene.units.length;
    return with_unit(extent, length.empty() || scene.geometry.dimension == 2 ? length : length + "2");
}

std::string percent_text(double fraction) {
    const double percent = 100.0 * fraction;
    if (percent >= 99.5) return fmt::format("{:.0f} %", percent);
    return percent > 0.0 && percent < 1e-3 ? "less than 0.001 %" : fmt::format("{:.2g} %", percent);
}

std::string instant_text(std::int64_t step, double time) { return fmt::format("step {}, time {:.6g}", step, time); }

}  // namespace cli
