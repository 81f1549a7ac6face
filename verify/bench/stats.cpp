// SPDX-License-Identifier: BSD-3-Clause
#include "stats.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bench {

double quantile(std::vector<double> sample, double q) {
    if (sample.empty()) return std::numeric_limits<double>::quiet_NaN();
    std::sort(sample.begin(), sample.end());
    const double at = q * static_cast<double>(sample.size() - 1);
    const auto low = static_cast<std::size_t>(at);
    const std::size_t high = std::min(low + 1, sample.size() - 1);
    const double part = at - static_cast<double>(low);
    return sample[low] * (1.0 - part) + sample[high] * part;
}

Json spread(const std::vector<double>& sample) {
    return {{"median", median(sample)},     {"min", quantile(sample, 0.0)}, {"q1", quantile(sample, 0.25)},
            {"q3", quantile(sample, 0.75)}, {"max", quantile(sample, 1.0)}, {"n", sample.size()}};
}

double exponent(const std::vector<double>& x, const std::vector<double>& y) {
    double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (!(x[i] > 0.0 && y[i] > 0.0)) continue;
        const double lx = std::log(x[i]);
        const double ly = std::log(y[i]);
        n += 1.0;
        sx += lx;
        sy += ly;
        sxx += lx * lx;
        sxy += lx * ly;
    }
    if (n < 2.0) return std::numeric_limits<double>::quiet_NaN();
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace bench
