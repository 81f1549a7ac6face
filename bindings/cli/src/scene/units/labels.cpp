// SPDX-License-Identifier: BSD-3-Clause
#include "scene/units/labels.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

namespace cli {

std::string energy_text(double energy, const Scene& scene, double largest) {
    return with_unit(energy, scene.geometry.dimension == 2 ? Quantity::line_energy : Quantity::energy,
                     scene.units.names, largest);
}

std::string extent_text(double extent, const Scene& scene) {
    return with_unit(extent, scene.geometry.dimension == 2 ? Quantity::length : Quantity::area, scene.units.names);
}

std::string length_text(double length, const Scene& scene) {
    return with_unit(length, Quantity::length, scene.units.names);
}

std::string release_rate_text(double rate, const Scene& scene) {
    return with_unit(rate, Quantity::release_rate, scene.units.names);
}

namespace {

// True if the factor of a pattern is the displacement itself, in one place at least.
bool is_displacement(const Scene& scene, std::size_t pattern) {
    const auto itself = [&](const Term& term) { return term.pattern == pattern && std::abs(term.coefficient) == 1; };
    const auto one_is = [&](const std::vector<Term>& terms) { return std::any_of(terms.begin(), terms.end(), itself); };
    return std::any_of(scene.prescriptions.begin(), scene.prescriptions.end(),
                       [&](const Prescription& one) { return one_is(one.terms); }) ||
           std::any_of(scene.equations.begin(), scene.equations.end(),
                       [&](const EquationData& one) { return one_is(one.right); });
}

std::string name_after(const Scale& scale) { return scale.name.empty() ? "" : " " + scale.name; }

}  // namespace

std::string load_text(double load, const Scene& scene, std::size_t pattern) {
    const bool length =
        !scene.cell && drives_of(scene)[pattern] == Drives::displacement && is_displacement(scene, pattern);
    const std::vector<Scale> scales =
        length ? scales_of(Quantity::length, scene.units.names) : std::vector<Scale>{{1, ""}};
    const Scale& scale = suiting(scales, std::abs(load));
    return fmt::format("{:.6g}{}", load * scale.factor, name_after(scale));
}

std::string reaction_text(double before, double after, const Scene& scene, std::size_t pattern) {
    const Drives drives = drives_of(scene)[pattern];
    const Quantity quantity = drives == Drives::force         ? Quantity::length
                              : scene.geometry.dimension == 2 ? Quantity::line_force
                                                              : Quantity::force;
    const std::vector<Scale> scales =
        drives == Drives::strain || scene.cell ? std::vector<Scale>{{1, ""}} : scales_of(quantity, scene.units.names);
    const Scale& scale = suiting(scales, std::max(std::abs(before), std::abs(after)));
    return fmt::format("{} to {}{}", short_number(before * scale.factor), short_number(after * scale.factor),
                       name_after(scale));
}

std::string short_number(double number) {
    constexpr double least = 1e3, most = 1e7;
    const double size = std::abs(number);
    return size >= least && size < most ? fmt::format("{:.0f}", number) : fmt::format("{:.4g}", number);
}

std::string percent_text(double fraction) {
    const double percent = 100.0 * fraction;
    if (percent >= 99.5) return fmt::format("{:.0f} %", percent);
    return percent > 0.0 && percent < 1e-3 ? "less than 0.001 %" : fmt::format("{:.2g} %", percent);
}

std::string instant_text(std::int64_t step, double time) { return fmt::format("step {}, time {:.6g}", step, time); }

}  // namespace cli
