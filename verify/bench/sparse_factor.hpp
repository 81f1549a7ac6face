// SPDX-License-Identifier: BSD-3-Clause
// CHOLMOD as a competent engineer would call it: default ordering, supernodal, analysed once, factored again and again
// on the kept pattern. Indices of 32 or 64 bits, so that the faster one can be taken.
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
    // Symbolic analysis. The matrix must stay where it is: its pattern and values are read by factorise().
    explicit SparseFactor(const UpperMatrix& matrix, bool wide = false);
    ~SparseFactor();
    SparseFactor(SparseFactor&&) noexcept;

    // Throws reference::Failure when a pivot is not positive.
    void factorise();
    void solve(const std::vector<double>& b, std::vector<double>& x);
    // Entries of L, bytes that CHOLMOD had allocated at most, and the ordering that it chose.
    double entries() const;
    double peak_bytes() const;
    const char* ordering() const;

    struct Interface;

private:
    std::unique_ptr<Interface> impl_;
};

}  // namespace bench
