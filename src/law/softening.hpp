// SPDX-License-Identifier: BSD-3-Clause
// The shapes of softening between onset and end, by name: the kinds of laws.
#pragma once

#include <string>
#include <variant>

#include "law/exponential_softening.hpp"
#include "law/host_softening.hpp"
#include "law/linear_softening.hpp"
#include "law/polyline_softening.hpp"

namespace delam {

// Onset and end are one: the law has a toughness only.
struct GriffithSoftening : LinearSoftening {};

using Softening = std::variant<LinearSoftening, ExponentialSoftening, TrapezoidalSoftening, TabulatedSoftening,
                               GriffithSoftening, HostSoftening>;
// Names of the kinds in the order of Softening.
inline constexpr const char* softening_names[] = {"piecewise-linear", "exponential", "trapezoidal",
                                                  "tabulated",        "griffith",    "host"};
static_assert(std::size(softening_names) == std::variant_size_v<Softening>);

// The shape of a kind as it is at first; false: no kind has this name.
bool softening_of(const std::string& name, Softening& softening);

}  // namespace delam
