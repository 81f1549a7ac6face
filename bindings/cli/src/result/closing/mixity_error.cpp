// SPDX-License-Identifier: BSD-3-Clause
#include "result/closing/mixity_error.hpp"

#include <fmt/format.h>

#include "scene/units/labels.hpp"

namespace cli {

namespace {

constexpr double told_error = 0.01;  // of what the step dissipates

}  // namespace

MixityError mixity_error_of(const Rows& rows) {
    MixityError out;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const double relative = number_of(rows[i], "mixity_error");
        if (!(relative > out.relative)) continue;
        out = {static_cast<std::int64_t>(number_of(rows[i], "step")), number_of(rows[i], "time"), relative,
               number_of(rows[i], "dissipated") - number_of(rows[i - 1], "dissipated")};
    }
    return out;
}

std::string mixity_error_line(const MixityError& error, const Scene& scene, double work) {
    if (!(error.relative > told_error)) return "";
    return fmt::format(
        "warning: mode mixity: an error of up to {} of the energy that a step dissipates ({}, which "
        "dissipates {}); smaller steps reduce it",
        percent_text(error.relative), instant_text(error.step, error.time), energy_text(error.dissipated, scene, work));
}

}  // namespace cli
