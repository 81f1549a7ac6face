// SPDX-License-Identifier: BSD-3-Clause
// A sparse Cholesky factor in single precision. A triangular solve waits for memory: half the bytes take half the time.
// Its solutions have seven digits less the condition of the matrix, as a preconditioner needs them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace delam {

// Places of the columns of a supernodal factor L, P A P^T = L L^T. The columns of a supernode are one dense block over
// its rows, column-major, the rows of its own triangle first. All arrays belong to the factor.
struct Supernodes {
    std::span<const std::int64_t> first;        // [supernodes + 1] columns
    std::span<const std::int64_t> row_start;    // [supernodes + 1] in `row`
    std::span<const std::int64_t> value_start;  // [supernodes] in the values
    std::span<const std::int64_t> row;
    std::span<const std::int64_t> order;  // [columns] variables in the order of elimination
};

// Rounds `count` numbers, times 2^-power, to single precision. They come to lie in the first half of the same memory.
const float* round_in_place(double* value, std::int64_t count, int power);

class SingleFactor {
public:
    // values: 2^-power L. They and the arrays of `nodes` must outlive the factor.
    SingleFactor(const Supernodes& nodes, const float* values, int power);
    // x = A^-1 b, of any size: b is scaled to 1 by a power of two.
    void solve(std::span<const double> b, std::span<double> x) const;

private:
    void forward(std::span<float> y) const;
    void backward(std::span<float> y) const;

    Supernodes nodes_;
    const float* values_;
    int power_;
    mutable std::vector<float> solution_, below_;  // kept between solves
};

}  // namespace delam
