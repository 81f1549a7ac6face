// SPDX-License-Identifier: BSD-3-Clause
// Sparse Cholesky factorisation by CHOLMOD (T. Davis). Only cholesky.cpp includes CHOLMOD.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "linalg/dense/dense.hpp"
#include "linalg/sparse/sparse.hpp"

namespace delam {

// Size of a factor, from its symbolic analysis.
struct FactorSize {
    double entries = 0.0;  // of L
    double flops = 0.0;    // of the numeric factorisation
};

class SparseCholesky {
public:
    // Symbolic analysis of a symmetric matrix (both triangles stored). The last `trailing` variables are eliminated
    // last, in their given order. The others come first, by (constrained) minimum degree or nested dissection,
    // whichever needs fewer operations by estimate. poll: called between orderings and analyses.
    explicit SparseCholesky(const SparseMatrix& matrix, std::int64_t trailing = 0, const Poll& poll = {});
    ~SparseCholesky();
    SparseCholesky(SparseCholesky&&) noexcept;
    SparseCholesky& operator=(SparseCholesky&&) noexcept;

    // Numeric factorisation of a matrix with the analysed pattern. False: not positive definite.
    bool factorise(const SparseMatrix& matrix);
    // Rounds a factor in supernodes to single precision, in half the memory, until the next factorise(); not one whose
    // pivots are too far apart for that. From then on there is solve() alone.
    void keep_single();
    // One right-hand side after another, as many as fit into b.
    void solve(std::span<const double> b, std::span<double> x) const;
    // x = A_ll^-1 b for the leading variables only (all but the trailing ones): forward substitution, drop the trailing
    // part, backward substitution.
    void solve_leading(std::span<const double> b, std::span<double> x) const;
    // Lower factor L_tt of the trailing variables: L_tt L_tt^T is the Schur complement onto them.
    DenseMatrix trailing_factor() const;
    // Result of the last factorise(), whether it succeeded or not: the variable with the smallest pivot, and the ratio
    // of that pivot to the largest; 0 if the factorisation broke down. largest: the root of the largest, a diagonal
    // entry of L.
    struct Pivot {
        std::int64_t variable = -1;
        double ratio = 1.0;
        double largest = 0.0;
    };
    Pivot smallest_pivot() const;
    // The variables in the order of elimination; without trailing ones a postorder of the elimination tree.
    std::vector<std::int64_t> order() const;
    double factor_entries() const;
    FactorSize size() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace delam
