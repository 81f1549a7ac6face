// SPDX-License-Identifier: BSD-3-Clause
#include "body/exact_translations.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace delam {

void make_translations_exact(std::vector<double>& matrix, std::size_t nodes, std::size_t dimension) {
    const std::size_t size = nodes * dimension;
    double largest = 0.0;
    for (const double v : matrix) largest = std::max(largest, std::abs(v));
    if (!(largest > 0.0) || !std::isfinite(largest)) return;
    const int exponent = std::ilogb(largest) + 1 - (nodes == 4 && dimension == 2 ? 51 : 50);
    std::vector<std::int64_t> k(matrix.size());
    for (std::size_t i = 0; i < k.size(); ++i) k[i] = std::llround(std::ldexp(matrix[i], -exponent));
    const auto entry = [&](std::size_t a, std::size_t i, std::size_t b, std::size_t j) -> std::int64_t& {
        return k[(a * dimension + i) * size + b * dimension + j];
    };

    // A symmetric diagonal block must answer two sums, over b of K_ab[ij] and of K_ab[ji]. Their difference is antisymmetric in (a, b), so it
    // sums to zero over a and can be handed from node to node.
    for (std::size_t i = 0; i < dimension; ++i) {
        for (std::size_t j = i + 1; j < dimension; ++j) {
            for (std::size_t a = 0; a + 1 < nodes; ++a) {
                std::int64_t difference = 0;
                for (std::size_t b = 0; b < nodes; ++b)
                    if (b != a) difference += entry(a, i, b, j) - entry(a, j, b, i);
                entry(a, i, a + 1, j) -= difference;
                entry(a + 1, j, a, i) -= difference;
            }
        }
    }
    for (std::size_t a = 0; a < nodes; ++a)
        for (std::size_t i = 0; i < dimension; ++i)
            for (std::size_t j = 0; j < dimension; ++j) {
                std::int64_t sum = 0;
                for (std::size_t b = 0; b < nodes; ++b)
                    if (b != a) sum += entry(a, i, b, j);
                entry(a, i, a, j) = -sum;
            }
    for (std::size_t i = 0; i < k.size(); ++i) matrix[i] = std::ldexp(static_cast<double>(k[i]), exponent);
}

}  // namespace delam
