// SPDX-License-Identifier: BSD-3-Clause
// A scene as the public API exports it. Everything that the reference knows about the mechanics comes from here.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "api.hpp"

namespace reference {

// The largest absolute value; 0 if there are no values.
inline double largest(const std::vector<double>& values) {
    double size = 0.0;
    for (const double v : values) size = std::max(size, std::abs(v));
    return size;
}

struct Csr {
    std::vector<std::int64_t> start{0};
    std::vector<std::int64_t> column;
    std::vector<double> value;
    std::size_t rows() const { return start.size() - 1; }
};

struct Exported {
    explicit Exported(const Scene& scene);

    int dimension = 0;
    std::size_t dofs = 0;     // dimension * mesh nodes
    Csr stiffness;            // all bodies over mesh DOFs, both triangles
    std::vector<bool> alive;  // DOFs of cells and of control nodes
    std::vector<Pairs> interfaces;
    struct Tie {  // u of node = sum of weight u
        std::int64_t node;
        std::vector<std::pair<std::int64_t, double>> of;
    };
    std::vector<Tie> ties;
    Csr constraints;  // over mesh DOFs
    std::size_t patterns = 0;
    std::vector<double> prescribed;           // [constraints][patterns]
    std::vector<std::vector<double>> forces;  // [patterns][dofs]: dead forces, or those of eigenstrains
    std::vector<double> strain_energy;        // [patterns][patterns] W, in 1/2 factor.W factor
    bool strains(std::size_t pattern) const { return strain_energy[pattern * patterns + pattern] > 0.0; }

    // Load at a time: prescribed values [constraints] and forces [dofs].
    void load(const Scene& scene, double time, std::vector<double>& values, std::vector<double>& force) const;
    std::vector<double> factors(const Scene& scene, double time) const;
};

}  // namespace reference
