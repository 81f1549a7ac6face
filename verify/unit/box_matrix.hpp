// SPDX-License-Identifier: BSD-3-Clause
// A sparse matrix with the pattern of hex8, for tests of factors.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "linalg/sparse/sparse.hpp"

namespace unit {

// Nodes of a grid with three variables each that are coupled to those of the 26 around it; with `trailing` the
// variables of the lowest plane come last.
inline delam::SparseMatrix box(std::int64_t along, std::int64_t across, std::int64_t up, bool trailing = false) {
    const std::int64_t plane = along * across, nodes = plane * up;
    const auto number = [&](std::int64_t x, std::int64_t y, std::int64_t z) {
        const std::int64_t n = (z * across + y) * along + x;
        return trailing ? (n + nodes - plane) % nodes : n;
    };
    std::vector<delam::Triplet> t;
    for (std::int64_t z = 0; z < up; ++z)
        for (std::int64_t y = 0; y < across; ++y)
            for (std::int64_t x = 0; x < along; ++x)
                for (std::int64_t k = 0; k < 27; ++k) {
                    const std::int64_t a = x + k % 3 - 1, b = y + k / 3 % 3 - 1, c = z + k / 9 - 1;
                    if (a < 0 || b < 0 || c < 0 || a >= along || b >= across || c >= up) continue;
                    const std::int64_t i = number(x, y, z), j = number(a, b, c);
                    for (std::int64_t v = 0; v < 9; ++v) {
                        const double value =
                            i == j ? (v % 4 == 0 ? 90.0 : 1.0) : -1.0 - 0.1 * static_cast<double>(v % 4 == 0);
                        t.push_back({3 * i + v / 3, 3 * j + v % 3, value});
                    }
                }
    return delam::from_triplets(3 * nodes, 3 * nodes, std::move(t));
}

inline std::vector<double> wave(std::int64_t n) {
    std::vector<double> b(static_cast<std::size_t>(n));
    for (std::size_t i = 0; i < b.size(); ++i)
        b[i] = 1.0 + static_cast<double>(i % 17) - 0.01 * static_cast<double>(i % 101);
    return b;
}

}  // namespace unit
