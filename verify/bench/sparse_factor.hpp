// SPDX-License-Identifier: BSD-3-Clause
// CHOLMOD as a competent engineer would use it: default ordering, supernodal, analysed once, factored repeatedly on the
// same pattern. Indices of 32 or 64 bits, so that the faster ones can be used.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

namespace bench {

// Upper triangle of a symmetric matrix by columns, rows ascending; the diagonal ends each column.
struct UpperMatrix {
    std::vector<std::int32_t> start{0};
    std::vector<std::int32_t> row;
    std::vector<double> value;
    std::size_t size() const { return start.size() - 1; }
};

class SparseFactor {
public:
    // Symbolic analysis. Keeps a reference to the matrix, whose pattern and values factorise() reads.
    explicit SparseFactor(const UpperMatrix& matrix, bool wide = false);
    ~SparseFactor();
    SparseFactor(SparseFactor&&) noexcept;

    // Throws reference::Failure if a pivot is not positive.
    void factorise();
    void solve(const std::vector<double>& b, std::vector<double>& x);
    // Entries of L, the largest number of bytes that CHOLMOD had allocated, and its ordering.
    double entries() const;
    double peak_bytes() const;
    const char* ordering() const;

    struct Interface;

private:
    std::unique_ptr<Interface> impl_;
};

}  // namespace bench
