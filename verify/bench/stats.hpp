// SPDX-License-Identifier: BSD-3-Clause
// Order statistics of repeated measurements, and the exponent of a power law.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

namespace bench {

using Json = nlohmann::ordered_json;

double quantile(std::vector<double> sample, double q);  // linear between order statistics; NaN when empty
inline double median(const std::vector<double>& sample) { return quantile(sample, 0.5); }
// {median, min, q1, q3, max, n}
Json spread(const std::vector<double>& sample);

// Exponent p of y = c x^p by least squares in the logarithms; NaN below two points.
double exponent(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace bench
