// SPDX-License-Identifier: BSD-3-Clause
// Compressed sparse rows with sorted columns. Symmetric matrices store both triangles, so their rows are also their
// columns.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/machine/large_pages.hpp"
#include "base/monitor.hpp"

namespace delam {

struct SparseMatrix {
    std::int64_t rows = 0;
    std::int64_t columns = 0;
    std::vector<std::int64_t> start{0};  // [rows+1]
    LargeVector<std::int64_t> column;    // sorted within a row
    LargeVector<double> value;

    std::int64_t entries() const { return static_cast<std::int64_t>(column.size()); }
};

struct Triplet {
    std::int64_t row;
    std::int64_t column;
    double value;
};
// Sums duplicates in the given order, so that the result is reproducible.
SparseMatrix from_triplets(std::int64_t rows, std::int64_t columns, std::vector<Triplet> triplets);

// Returns A + B, with every entry of either.
SparseMatrix sum(const SparseMatrix& a, const SparseMatrix& b);

// y = A x
void multiply(const SparseMatrix& a, std::span<const double> x, std::span<double> y);
// y = A^T x
void multiply_transposed(const SparseMatrix& a, std::span<const double> x, std::span<double> y);

SparseMatrix transpose(const SparseMatrix& a);

// T^T K T of a symmetric K with both triangles stored.
SparseMatrix congruence(const SparseMatrix& k, const SparseMatrix& t, const Poll& poll = {});

}  // namespace delam
