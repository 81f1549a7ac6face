// SPDX-License-Identifier: BSD-3-Clause
// Dense column-major matrices and the LAPACK kernels that the library needs.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/machine/large_pages.hpp"
#include "base/monitor.hpp"
#include "base/numbers.hpp"

namespace delam {

struct DenseMatrix {
    std::int64_t rows = 0;
    std::int64_t columns = 0;
    LargeVector<double> value;  // column-major

    DenseMatrix() = default;
    DenseMatrix(std::int64_t r, std::int64_t c) : rows(r), columns(c), value(index(r * c), 0.0) {}
    // Its entries have no value yet.
    static DenseMatrix unset(std::int64_t r, std::int64_t c) {
        DenseMatrix a;
        a.rows = r;
        a.columns = c;
        a.value.resize(index(r * c));
        return a;
    }
    double& operator()(std::int64_t i, std::int64_t j) { return value[index(i + j * rows)]; }
    double operator()(std::int64_t i, std::int64_t j) const { return value[index(i + j * rows)]; }
};

// Large products, factors and solves are shared by the threads of a TeamScope; no digit depends on their number.
// poll: called every few milliseconds in operations that take longer than that.

inline std::span<double> column(DenseMatrix& a, std::int64_t c) {
    return std::span<double>(a.value).subspan(index(c * a.rows), index(a.rows));
}
inline std::span<const double> column(const DenseMatrix& a, std::int64_t c) {
    return std::span<const double>(a.value).subspan(index(c * a.rows), index(a.rows));
}
double dot(std::span<const double> x, std::span<const double> y);
// y += a x
void add_scaled(double a, std::span<const double> x, std::span<double> y);
// y = S x, S symmetric with its lower triangle given (BLAS dsymv).
void multiply_symmetric(const DenseMatrix& s, std::span<const double> x, std::span<double> y);
// C = A B
DenseMatrix multiply(const DenseMatrix& a, const DenseMatrix& b);
// C = A^T B; with `first`, over the rows from `first` on.
DenseMatrix multiply_transposed(const DenseMatrix& a, const DenseMatrix& b, std::int64_t first = 0);
// L L^T, full symmetric, from a lower triangle (the upper one must be zero): n^3/3 multiplications.
DenseMatrix lower_times_transpose(const DenseMatrix& lower, const Poll& poll = {});
// y = A x and y = A^T x (BLAS dgemv)
void multiply(const DenseMatrix& a, std::span<const double> x, std::span<double> y);
void multiply_transposed(const DenseMatrix& a, std::span<const double> x, std::span<double> y);
// Copies the lower triangle to the upper one.
void mirror_lower(DenseMatrix& a);
// A = L L^T in the lower triangle (LAPACK dpotrf; large matrices panel by panel). False: not positive definite, and A
// is overwritten.
bool factor_definite(DenseMatrix& a, const Poll& poll = {});
// L^-1 B, L^-1 x, L^-T x in place (BLAS dtrsm, dtrsv); only the lower triangle is read.
// first: the rows of B above it are zero.
void solve_lower(const DenseMatrix& lower, DenseMatrix& b, std::int64_t first = 0, const Poll& poll = {});
void solve_lower(const DenseMatrix& lower, std::span<double> x);
void solve_lower_transposed(const DenseMatrix& lower, std::span<double> x);
// C -= V^T V and C += V^T V in the lower triangle of C (BLAS dsyrk).
void subtract_gram(DenseMatrix& c, const DenseMatrix& v, const Poll& poll = {});
void add_gram(DenseMatrix& c, const DenseMatrix& v, const Poll& poll = {});
// C -= V^T W (BLAS dgemm)
void subtract_product(DenseMatrix& c, const DenseMatrix& v, const DenseMatrix& w);
// A^-1, full symmetric, of a positive definite A (LAPACK dpotrf, dpotri; beyond 1024 rows in panels, on one thread).
DenseMatrix inverse_definite(DenseMatrix a, const Poll& poll = {});
// The same in place. False: A is not positive definite, and it is overwritten.
bool invert_definite(DenseMatrix& a, const Poll& poll = {});
// A X = B in place of B, by LU with rows scaled to 1 (LAPACK dgetrf, dgetrs); overwrites A. False: A is singular, no
// pivot larger than `tolerance` times the largest; B is then undefined.
bool solve_general(DenseMatrix& a, DenseMatrix& b, double tolerance);
// Orthonormal basis of the span of the columns, which must be independent (modified Gram-Schmidt, twice).
DenseMatrix orthonormalised(DenseMatrix a);
// The same in place; the columns of `with` are combined as those of a.
void orthonormalise(DenseMatrix& a, DenseMatrix& with);
// Eigenpairs of a symmetric matrix, ascending; vectors in columns (LAPACK dsyev).
struct Eigen {
    std::vector<double> value;
    DenseMatrix vector;
};
Eigen eigen_symmetric(DenseMatrix a);

// Column order of a rank-revealing QR factorisation of A (LAPACK dgeqp3), and the numerical rank for a relative
// tolerance on the diagonal of R.
struct PivotedColumns {
    std::vector<std::int64_t> order;
    std::int64_t rank;
};
PivotedColumns pivoted_columns(DenseMatrix a, double tolerance);

}  // namespace delam
