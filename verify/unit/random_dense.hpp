// SPDX-License-Identifier: BSD-3-Clause
// Random numbers, dense matrices by brute force, and comparisons, for tests of the parts of the dense operators.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "check.hpp"
#include "linalg/dense/dense.hpp"
#include "linalg/sparse/sparse.hpp"

namespace unit {

using namespace delam;

using Index = std::int64_t;

inline std::size_t at(Index i) { return static_cast<std::size_t>(i); }

class Random {
public:
    explicit Random(unsigned seed) : engine_(seed) {}
    double real(double low = -1.0, double high = 1.0) {
        return std::uniform_real_distribution<double>(low, high)(engine_);
    }
    bool one_in(int n) { return std::uniform_int_distribution<int>(1, n)(engine_) == 1; }
    Index below(Index n) { return std::uniform_int_distribution<Index>(0, n - 1)(engine_); }
    DenseMatrix matrix(Index rows, Index columns) {
        DenseMatrix a(rows, columns);
        for (double& v : a.value) v = real();
        return a;
    }
    std::vector<double> vector(Index n) {
        std::vector<double> v(at(n));
        for (double& x : v) x = real();
        return v;
    }
    // Positive definite, with eigenvalues of about 1 to n.
    DenseMatrix definite(Index n) {
        const DenseMatrix g = matrix(n, n);
        DenseMatrix s = multiply_transposed(g, g);
        for (Index i = 0; i < n; ++i) s(i, i) += 1.0;
        mirror_lower(s);
        return s;
    }
    template <class T>
    void shuffle(T& list) {
        std::shuffle(list.begin(), list.end(), engine_);
    }

private:
    std::mt19937 engine_;
};

inline double largest(std::span<const double> v) {
    double m = 0.0;
    for (const double x : v) m = std::max(m, std::abs(x));
    return m;
}

inline double distance(std::span<const double> a, std::span<const double> b) {
    ck_assert_uint_eq(a.size(), b.size());
    double m = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        m = std::isnan(a[i] - b[i]) ? HUGE_VAL : std::max(m, std::abs(a[i] - b[i]));
    return m;
}

inline void expect_close(std::span<const double> a, std::span<const double> b, double tolerance, const char* what) {
    const double off = distance(a, b), scale = std::max(largest(b), 1e-20);
    ck_assert_msg(off <= tolerance * scale, "%s: off by %.2e of %.3g", what, off, scale);
}

inline DenseMatrix plain_product(const DenseMatrix& a, const DenseMatrix& b) {
    DenseMatrix c(a.rows, b.columns);
    for (Index j = 0; j < b.columns; ++j)
        for (Index k = 0; k < a.columns; ++k) {
            // By pointers, because this test is compiled without optimisation.
            const double *column = a.value.data() + k * a.rows, factor = b(k, j);
            double* sum = c.value.data() + j * a.rows;
            for (const double* end = column + a.rows; column != end; ++column) *sum++ += *column * factor;
        }
    return c;
}

inline DenseMatrix flipped(const DenseMatrix& a) {
    DenseMatrix t(a.columns, a.rows);
    for (Index j = 0; j < a.columns; ++j)
        for (Index i = 0; i < a.rows; ++i) t(j, i) = a(i, j);
    return t;
}

inline DenseMatrix lower_of(DenseMatrix a) {
    for (Index j = 0; j < a.columns; ++j)
        for (Index i = 0; i < j; ++i) a(i, j) = 0.0;
    return a;
}

inline DenseMatrix dense_of(const SparseMatrix& s) {
    DenseMatrix d(s.rows, s.columns);
    for (Index i = 0; i < s.rows; ++i)
        for (Index e = s.start[at(i)]; e < s.start[at(i) + 1]; ++e) d(i, s.column[at(e)]) += s.value[at(e)];
    return d;
}

}  // namespace unit
