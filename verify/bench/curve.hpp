// SPDX-License-Identifier: BSD-3-Clause
// Histories as piecewise linear curves over the load, and their distances.
#pragma once

#include <vector>

#include "record.hpp"

namespace bench {

struct Curve {
    std::vector<double> x{0.0}, y{0.0};  // from the unloaded state
    double at(double where) const;
};
Curve reaction_curve(const March& march);
Curve dissipation_curve(const March& march);

// Integral of |a - b| over the path, over that of |b|.
double distance(const Curve& a, const Curve& b);

}  // namespace bench
