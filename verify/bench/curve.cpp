// SPDX-License-Identifier: BSD-3-Clause
#include "curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bench {
namespace {

constexpr int samples = 5000;  // of the trapezoidal rule; far more than steps

Curve make(const Analysis& analysis, double StepRecord::*value) {
    Curve c;
    for (const StepRecord& r : analysis.steps) {
        c.x.push_back(r.load);
        c.y.push_back(r.*value);
    }
    return c;
}

}  // namespace

double Curve::at(double where) const {
    const auto right = std::lower_bound(x.begin(), x.end(), where);
    if (right == x.begin()) return y.front();
    if (right == x.end()) return y.back();
    const auto i = static_cast<std::size_t>(right - x.begin());
    const double part = (where - x[i - 1]) / (x[i] - x[i - 1]);
    return y[i - 1] * (1.0 - part) + y[i] * part;
}

Curve reaction_curve(const Analysis& analysis) { return make(analysis, &StepRecord::reaction); }
Curve dissipation_curve(const Analysis& analysis) { return make(analysis, &StepRecord::dissipated); }

double distance(const Curve& a, const Curve& b) {
    const double end = b.x.back();
    double difference = 0.0;
    double size = 0.0;
    for (int i = 0; i <= samples; ++i) {
        const double x = end * i / samples;
        const double weight = i == 0 || i == samples ? 0.5 : 1.0;
        difference += weight * std::abs(a.at(x) - b.at(x));
        size += weight * std::abs(b.at(x));
    }
    return size > 0.0 ? difference / size : std::numeric_limits<double>::quiet_NaN();
}

Extrapolation richardson(double x_coarse, double x_middle, double x_finest, double d_coarse, double d_middle) {
    const auto ratio = [&](double p) {
        return (std::pow(x_coarse / x_finest, p) - 1.0) / (std::pow(x_middle / x_finest, p) - 1.0);
    };
    double low = 0.5;
    double high = 6.0;
    for (int i = 0; i < 60; ++i) {
        const double p = 0.5 * (low + high);
        (ratio(p) < d_coarse / d_middle ? low : high) = p;
    }
    return {low, d_middle / (std::pow(x_middle / x_finest, low) - 1.0)};
}

}  // namespace bench
