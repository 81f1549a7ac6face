// SPDX-License-Identifier: BSD-3-Clause
#include "orders.hpp"

#include <cmath>
#include <limits>

namespace harness {

// (v1 - v2) / (v2 - v3) = ((s1/s3)^p - (s2/s3)^p) / ((s2/s3)^p - 1), which grows with p.
double order_of_values(const std::vector<double>& sizes, const std::vector<double>& values) {
    const std::size_t n = values.size();
    if (n < 3) return nan;
    const double ratio = (values[n - 3] - values[n - 2]) / (values[n - 2] - values[n - 1]);
    const double first = sizes[n - 3] / sizes[n - 1];
    const double second = sizes[n - 2] / sizes[n - 1];
    const auto predicted = [&](double p) {
        return (std::pow(first, p) - std::pow(second, p)) / (std::pow(second, p) - 1.0);
    };
    double low = 0.05;
    double high = 8.0;
    if (!(ratio >= predicted(low) && ratio <= predicted(high))) return nan;
    for (int i = 0; i < 60; ++i) {
        const double p = 0.5 * (low + high);
        (predicted(p) < ratio ? low : high) = p;
    }
    return low;
}

double richardson(const std::vector<double>& sizes, const std::vector<double>& values, double order) {
    const std::size_t n = values.size();
    if (n < 2) return nan;
    return values[n - 1] + (values[n - 1] - values[n - 2]) / (std::pow(sizes[n - 2] / sizes[n - 1], order) - 1.0);
}

}  // namespace harness
