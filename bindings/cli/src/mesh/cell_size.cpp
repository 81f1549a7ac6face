// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/cell_size.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "text/number.hpp"

namespace cli {

namespace {

// Largest size that divides both (Euclid's algorithm); remainders below a millionth are rounding of the decimals.
double common_size(double a, double b, double slack) {
    while (b > slack) {
        const double rest = std::abs(a - b * std::round(a / b));
        a = b;
        b = rest;
    }
    return a;
}

}  // namespace

bool divides(double h, double length) {
    const double whole = std::round(length / h);
    return whole >= 1 && std::abs(length / h - whole) <= 1e-6 * whole;
}

std::string suggested_size(const std::vector<double>& lengths, double h) {
    const auto [least, largest] = std::minmax_element(lengths.begin(), lengths.end());
    if (lengths.empty() || !(*least > 0) || !std::isfinite(*largest) || !(h > 0)) return "";
    double common = lengths.front();
    for (const double length : lengths) common = common_size(common, length, 1e-6 * *least);
    // The sizes that divide all lengths are `common` over whole numbers; considers those from h/2 to 2 h.
    const double middle = std::max(1.0, std::round(common / h));
    if (!(middle < 1e4)) return "";
    std::string best;
    double best_cost = std::numeric_limits<double>::infinity();
    for (double k = std::max(1.0, std::floor(middle / 2)); k <= 2 * middle; k += 1) {
        // Prefers few digits, then closeness to the requested size.
        for (int digits = 1; digits <= 9; ++digits) {
            const std::string text = fmt::format("{:.{}g}", common / k, digits);
            const double value = number_in(text);
            if (!std::all_of(lengths.begin(), lengths.end(), [&](double l) { return divides(value, l); })) continue;
            const double cost = digits + 4 * std::abs(std::log2(k / middle));
            if (cost < best_cost) {
                best_cost = cost;
                best = text;
            }
            break;
        }
    }
    return best;
}

}  // namespace cli
