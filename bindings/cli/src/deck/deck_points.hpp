// SPDX-License-Identifier: BSD-3-Clause
// Values over time as points with straight lines between them.
#pragma once

#include <utility>
#include <vector>

#include "deck/cards/deck.hpp"

namespace cli::abaqus {

using Points = std::vector<std::pair<double, double>>;  // instants and values

// The value at an instant; constant before the first point and after the last.
double between(const Points& points, double x);
// The values of an amplitude as straight lines; a SMOOTH STEP, whose parts are polynomials of fifth order, in 16 each.
Points lines_of(const Amplitude& amplitude);

}  // namespace cli::abaqus
