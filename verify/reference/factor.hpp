// SPDX-License-Identifier: BSD-3-Clause
// Sparse Cholesky factor (CHOLMOD) of a symmetrically scaled matrix, and refinement with extended residuals.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace reference {

// Entries of the lower triangle; repeated ones add up.
struct Triplets {
    std::vector<std::int64_t> row, column;
    std::vector<double> value;
    void add(std::int64_t i, std::int64_t j, double v) {
        if (i < j) return;
        row.push_back(i);
        column.push_back(j);
        value.push_back(v);
    }
};

class Factor {
public:
    // Throws Failure if the matrix is singular to working precision: some body is not held then.
    Factor(std::size_t n, const Triplets& lower);
    ~Factor();
    Factor(const Factor&) = delete;
    Factor& operator=(const Factor&) = delete;

    std::vector<double> solve(const std::vector<double>& right) const;

    // Solves residual(x) = 0 for an affine residual whose negative derivative is the matrix, by refinement in extended
    // precision until the corrections stop decreasing.
    using Residual = std::function<std::vector<long double>(const std::vector<long double>&)>;
    std::vector<long double> refine(const Residual& residual) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace reference
