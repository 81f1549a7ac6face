// SPDX-License-Identifier: BSD-3-Clause
// Histories as piecewise linear curves over the load, and distances between them.
#pragma once

#include <vector>

#include "record.hpp"

namespace bench {

struct Curve {
    std::vector<double> x{0.0}, y{0.0};  // from the unloaded state
    double at(double where) const;
};
Curve reaction_curve(const Analysis& analysis);
Curve dissipation_curve(const Analysis& analysis);

// Integral of |a - b| over the path, divided by that of |b|.
double distance(const Curve& a, const Curve& b);

// Richardson extrapolation: with errors c x^p, the distances of two coarser results from the finest are c (x_i^p -
// x_finest^p). Their ratio determines p (it grows with p, which is bisected within 0.5 .. 6), and c x_finest^p is the
// error of the finest.
struct Extrapolation {
    double order;
    double error;
};
Extrapolation richardson(double x_coarse, double x_middle, double x_finest, double d_coarse, double d_middle);

}  // namespace bench
