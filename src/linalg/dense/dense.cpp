// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/dense/dense.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "base/team.hpp"
#include "delam/delam.h"
#include "linalg/dense/blas.hpp"
#include "linalg/dense/blas_size.hpp"

namespace delam {

namespace {

constexpr int one = 1;

// LAPACK factorises up to `small` rows without a poll in between; larger matrices are treated in panels of `width`
// columns. (Measured on 500 to 3500 rows: 0.95 to 1.0 times the time of LAPACK, panels of 256 columns up to 1.14.)
constexpr std::int64_t small = 384, width = 96;
// Inverses: from these on.
constexpr std::int64_t small_inverse = 1024, wide = 256;

// Multiplications between two polls: some milliseconds.
constexpr double part = 5e7;

// Multiplications of a piece for one thread. They take about half a millisecond: much less than the time slice for
// which a thread may have to wait where other programs use the cores, and ten times the time to wake a thread. The
// pieces depend on the sizes alone, so that no digit depends on the number of threads.
constexpr double piece = 8e6;

// Calls operation(first, count) for pieces of the columns, or rows, each of which takes `cost` multiplications. Each is
// computed by itself.
template <class Operation>
void in_pieces(std::int64_t all, double cost, const Operation& operation, const Poll& poll) {
    if (all == 0) return;
    // Narrower ones take 1.1 times the time in the kernels of the BLAS.
    constexpr std::int64_t narrowest = 128, multiple = 64;
    std::int64_t step = all;
    if (cost * static_cast<double>(all) >= 2.0 * piece)
        step = std::min(all, std::max(narrowest, static_cast<std::int64_t>(piece / cost) / multiple * multiple));
    const auto between =
        std::max<std::int64_t>(1, static_cast<std::int64_t>(part / (cost * static_cast<double>(step))));
    std::int64_t polled = 0;
    share((all + step - 1) / step,
          [&](std::int64_t p) { operation(p * step, static_cast<int>(std::min(step, all - p * step))); },
          [&](std::int64_t done) {
              if (done < polled + between) return;
              polled = done;
              call_if_set(poll);
          });
    call_if_set(poll);
}

int leading(const DenseMatrix& a) {
    if (a.columns > 0 && a.rows > std::numeric_limits<int>::max() / a.columns)
        fail(DELAM_ERROR_MEMORY, "a dense block of ", a.rows, " rows and ", a.columns,
             " columns is too large; more subdomains make smaller ones");
    return std::max(1, blas_size(a.rows));
}

}  // namespace

// Adds in four sums, because each addition waits for the one before in the same sum. The BLAS has such a function, too,
// but its digits may depend on its threads.
double dot(std::span<const double> x, std::span<const double> y) {
    const std::size_t n = x.size(), whole = n - n % 4;
    const double *a = x.data(), *b = y.data();
    double s0 = 0.0, s1 = 0.0, s2 = 0.0, s3 = 0.0;
    for (std::size_t i = 0; i < whole; i += 4) {
        s0 += a[i] * b[i];
        s1 += a[i + 1] * b[i + 1];
        s2 += a[i + 2] * b[i + 2];
        s3 += a[i + 3] * b[i + 3];
    }
    double rest = 0.0;
    for (std::size_t i = whole; i < n; ++i) rest += a[i] * b[i];
    return (s0 + s1) + (s2 + s3) + rest;
}

void add_scaled(double a, std::span<const double> x, std::span<double> y) {
    for (std::size_t i = 0; i < x.size(); ++i) y[i] += a * x[i];
}

void multiply_symmetric(const DenseMatrix& s, std::span<const double> x, std::span<double> y) {
    const int n = blas_size(s.rows), lda = leading(s);
    const double alpha = 1.0, beta = 0.0;
    if (n > 0) blas::symv("L", &n, &alpha, s.value.data(), &lda, x.data(), &one, &beta, y.data(), &one);
}

DenseMatrix multiply(const DenseMatrix& a, const DenseMatrix& b) {
    if (a.columns == 0) return {a.rows, b.columns};
    DenseMatrix c = DenseMatrix::unset(a.rows, b.columns);
    const int m = blas_size(a.rows), n = blas_size(b.columns), k = blas_size(a.columns);
    const int lda = leading(a), ldb = leading(b), ldc = leading(c);
    const double alpha = 1.0, beta = 0.0;
    if (m == 0 || n == 0) return c;
    const auto columns = [&](std::int64_t j, int count) {
        blas::gemm("N", "N", &m, &count, &k, &alpha, a.value.data(), &lda, b.value.data() + j * b.rows, &ldb, &beta,
                   c.value.data() + j * c.rows, &ldc);
    };
    in_pieces(n, static_cast<double>(m) * k, columns, {});
    return c;
}

DenseMatrix multiply_transposed(const DenseMatrix& a, const DenseMatrix& b, std::int64_t first) {
    if (a.rows == first) return {a.columns, b.columns};
    DenseMatrix c = DenseMatrix::unset(a.columns, b.columns);
    const int m = blas_size(a.columns), n = blas_size(b.columns), k = blas_size(a.rows - first);
    const int lda = leading(a), ldb = leading(b), ldc = leading(c);
    const double alpha = 1.0, beta = 0.0;
    if (m == 0 || n == 0) return c;
    const auto columns = [&](std::int64_t j, int count) {
        blas::gemm("T", "N", &m, &count, &k, &alpha, a.value.data() + first, &lda, b.value.data() + first + j * b.rows,
                   &ldb, &beta, c.value.data() + j * c.rows, &ldc);
    };
    in_pieces(n, static_cast<double>(m) * k, columns, {});
    return c;
}

// Mirrors in square tiles that fit the cache: a plain double loop would miss the cache at every element of one
// triangle.
void mirror_lower(DenseMatrix& a) {
    constexpr std::int64_t block = 32;
    for (std::int64_t bj = 0; bj < a.columns; bj += block)
        for (std::int64_t bi = bj; bi < a.rows; bi += block)
            for (std::int64_t j = bj; j < std::min(bj + block, a.columns); ++j)
                for (std::int64_t i = std::max(bi, j + 1); i < std::min(bi + block, a.rows); ++i) a(j, i) = a(i, j);
}

// Multiplies by column panels of the product: rows behind a panel have L's columns up to its end in common with it.
DenseMatrix lower_times_transpose(const DenseMatrix& lower, const Poll& poll) {
    DenseMatrix product;
    make_room(product.value, index(lower.rows * lower.rows));
    product.rows = product.columns = lower.rows;
    product.value.resize(index(lower.rows * lower.rows));
    const int lda = leading(lower);
    const double unit = 1.0, none = 0.0;
    const auto panel = [&](std::int64_t p) {
        const std::int64_t j = p * width;
        const int columns = static_cast<int>(std::min(width, lower.rows - j)),
                  rest = static_cast<int>(lower.rows - j - columns), common = static_cast<int>(j + columns);
        const double* row = lower.value.data() + j;
        double* corner = product.value.data() + j * (lower.rows + 1);
        blas::syrk("L", "N", &columns, &common, &unit, row, &lda, &none, corner, &lda);
        if (rest > 0)
            blas::gemm("N", "T", &rest, &columns, &common, &unit, row + columns, &lda, row, &lda, &none,
                       corner + columns, &lda);
    };
    if (lower.rows > 0) share((lower.rows + width - 1) / width, panel, [&](std::int64_t) { call_if_set(poll); });
    mirror_lower(product);
    return product;
}

void multiply(const DenseMatrix& a, std::span<const double> x, std::span<double> y) {
    const int m = blas_size(a.rows), n = blas_size(a.columns), lda = leading(a);
    const double alpha = 1.0, beta = 0.0;
    if (m > 0 && n > 0)
        blas::gemv("N", &m, &n, &alpha, a.value.data(), &lda, x.data(), &one, &beta, y.data(), &one);
    else
        std::fill(y.begin(), y.end(), 0.0);
}

void multiply_transposed(const DenseMatrix& a, std::span<const double> x, std::span<double> y) {
    const int m = blas_size(a.rows), n = blas_size(a.columns), lda = leading(a);
    const double alpha = 1.0, beta = 0.0;
    if (m > 0 && n > 0)
        blas::gemv("T", &m, &n, &alpha, a.value.data(), &lda, x.data(), &one, &beta, y.data(), &one);
    else
        std::fill(y.begin(), y.end(), 0.0);
}

// Factorises more than `small` rows panel by panel: the panel's own triangle, the rows below it, then its contribution
// to the columns behind it.
bool factor_definite(DenseMatrix& a, const Poll& poll) {
    const int n = blas_size(a.rows), lda = leading(a);
    int info = 0;
    if (n <= small) {
        if (n > 0) blas::potrf("L", &n, a.value.data(), &lda, &info);
        return info == 0;
    }
    const double unit = 1.0, minus = -1.0;
    const auto at = [&a](std::int64_t i, std::int64_t j) { return a.value.data() + i + j * a.rows; };
    double passed = 0.0;
    for (std::int64_t k = 0; k < n; k += width) {
        const int panel = static_cast<int>(std::min<std::int64_t>(width, n - k)),
                  below = static_cast<int>(n - k - panel);
        blas::potrf("L", &panel, at(k, k), &lda, &info);
        if (info != 0) return false;
        if (below == 0) break;
        const std::int64_t behind = k + panel;
        const auto rows = [&](std::int64_t i, int count) {
            blas::trsm("R", "L", "T", "N", &count, &panel, &unit, at(k, k), &lda, at(behind + i, k), &lda);
        };
        const auto columns = [&](std::int64_t offset, int count) {
            const std::int64_t j = behind + offset;
            const int rest = static_cast<int>(n - j - count);
            blas::syrk("L", "N", &count, &panel, &minus, at(j, k), &lda, &unit, at(j, j), &lda);
            if (rest > 0)
                blas::gemm("N", "T", &rest, &count, &panel, &minus, at(j + count, k), &lda, at(j, k), &lda, &unit,
                           at(j + count, j), &lda);
        };
        const double update = static_cast<double>(below) * panel;
        in_pieces(below, 0.5 * panel * panel, rows, {});
        passed += 0.5 * update * below;
        in_pieces(below, 0.5 * update, columns, passed < part ? Poll() : poll);
        if (passed >= part) passed = 0.0;
    }
    return true;
}

void solve_lower(const DenseMatrix& lower, DenseMatrix& b, std::int64_t first, const Poll& poll) {
    const int m = blas_size(b.rows - first), lda = leading(lower), ldb = leading(b);
    const double alpha = 1.0;
    if (m == 0) return;
    const auto columns = [&](std::int64_t j, int count) {
        blas::trsm("L", "L", "N", "N", &m, &count, &alpha, lower.value.data() + first * (lower.rows + 1), &lda,
                   b.value.data() + first + j * b.rows, &ldb);
    };
    in_pieces(b.columns, 0.5 * m * m, columns, poll);
}

void solve_lower(const DenseMatrix& lower, std::span<double> x) {
    const int n = blas_size(lower.rows), lda = leading(lower);
    if (n > 0) blas::trsv("L", "N", "N", &n, lower.value.data(), &lda, x.data(), &one);
}

void solve_lower_transposed(const DenseMatrix& lower, std::span<double> x) {
    const int n = blas_size(lower.rows), lda = leading(lower);
    if (n > 0) blas::trsv("L", "T", "N", &n, lower.value.data(), &lda, x.data(), &one);
}

namespace {

void accumulate_gram(DenseMatrix& c, const DenseMatrix& v, double sign, const Poll& poll) {
    const int n = blas_size(c.rows), k = blas_size(v.rows), ldv = leading(v), ldc = leading(c);
    const double beta = 1.0;
    if (n == 0 || k == 0) return;
    const auto column = [&v](std::int64_t j) { return v.value.data() + j * v.rows; };
    const auto columns = [&](std::int64_t j, int count) {
        const int rest = static_cast<int>(n - j - count);
        double* corner = c.value.data() + j * (c.rows + 1);
        blas::syrk("L", "T", &count, &k, &sign, column(j), &ldv, &beta, corner, &ldc);
        if (rest > 0)
            blas::gemm("T", "N", &rest, &count, &k, &sign, column(j + count), &ldv, column(j), &ldv, &beta,
                       corner + count, &ldc);
    };
    in_pieces(n, 0.5 * n * k, columns, poll);
}

}  // namespace

void subtract_gram(DenseMatrix& c, const DenseMatrix& v, const Poll& poll) { accumulate_gram(c, v, -1.0, poll); }

void add_gram(DenseMatrix& c, const DenseMatrix& v, const Poll& poll) { accumulate_gram(c, v, 1.0, poll); }

void subtract_product(DenseMatrix& c, const DenseMatrix& v, const DenseMatrix& w) {
    const int m = blas_size(c.rows), n = blas_size(c.columns), k = blas_size(v.rows);
    const int ldv = leading(v), ldw = leading(w), ldc = leading(c);
    const double alpha = -1.0, beta = 1.0;
    if (m > 0 && n > 0 && k > 0)
        blas::gemm("T", "N", &m, &n, &k, &alpha, v.value.data(), &ldv, w.value.data(), &ldw, &beta, c.value.data(),
                   &ldc);
}

namespace {

// Replaces L in the lower triangle by L^-1, panels from right to left: below the diagonal block -L_22^-1 L_21 L_11^-1.
int invert_lower(DenseMatrix& a, const Poll& poll) {
    const std::int64_t n = a.rows;
    const int lda = leading(a);
    const double unit = 1.0, minus = -1.0;
    const auto at = [&a](std::int64_t i, std::int64_t j) { return a.value.data() + i + j * a.rows; };
    for (std::int64_t k = (n - 1) / wide * wide; k >= 0; k -= wide) {
        const int panel = static_cast<int>(std::min(wide, n - k)), below = static_cast<int>(n - k - panel);
        if (below > 0) {
            blas::trmm("L", "L", "N", "N", &below, &panel, &unit, at(k + panel, k + panel), &lda, at(k + panel, k),
                       &lda);
            blas::trsm("R", "L", "N", "N", &below, &panel, &minus, at(k, k), &lda, at(k + panel, k), &lda);
        }
        int info = 0;
        blas::trtri("L", "N", &panel, at(k, k), &lda, &info);
        if (info != 0) return info;
        call_if_set(poll);
    }
    return 0;
}

// Replaces M in the lower triangle by M^T M, block rows from top to bottom.
void lower_transpose_times_lower(DenseMatrix& a, const Poll& poll) {
    const std::int64_t n = a.rows;
    const int lda = leading(a);
    const double unit = 1.0;
    const auto at = [&a](std::int64_t i, std::int64_t j) { return a.value.data() + i + j * a.rows; };
    for (std::int64_t k = 0; k < n; k += wide) {
        const int panel = static_cast<int>(std::min(wide, n - k)), below = static_cast<int>(n - k - panel),
                  before = static_cast<int>(k);
        int info = 0;
        if (before > 0) blas::trmm("L", "L", "T", "N", &panel, &before, &unit, at(k, k), &lda, at(k, 0), &lda);
        blas::lauum("L", &panel, at(k, k), &lda, &info);
        if (below > 0) {
            if (before > 0)
                blas::gemm("T", "N", &panel, &before, &below, &unit, at(k + panel, k), &lda, at(k + panel, 0), &lda,
                           &unit, at(k, 0), &lda);
            blas::syrk("L", "T", &panel, &below, &unit, at(k + panel, k), &lda, &unit, at(k, k), &lda);
        }
        call_if_set(poll);
    }
}

}  // namespace

bool invert_definite(DenseMatrix& a, const Poll& poll) {
    const int n = blas_size(a.rows), lda = leading(a);
    int info = 0;
    if (!factor_definite(a, poll)) return false;
    call_if_set(poll);
    if (n > small_inverse) {
        info = invert_lower(a, poll);
        if (info == 0) lower_transpose_times_lower(a, poll);
    } else if (n > 0) {
        blas::potri("L", &n, a.value.data(), &lda, &info);
    }
    if (info != 0) return false;
    call_if_set(poll);
    mirror_lower(a);
    return true;
}

DenseMatrix inverse_definite(DenseMatrix a, const Poll& poll) {
    if (!invert_definite(a, poll))
        fail(DELAM_ERROR_NUMERICAL, "a dense block of ", a.rows, " rows is not positive definite");
    return a;
}

DenseMatrix orthonormalised(DenseMatrix a) {
    DenseMatrix none(0, a.columns);
    orthonormalise(a, none);
    return a;
}

void orthonormalise(DenseMatrix& a, DenseMatrix& with) {
    const auto column = [](DenseMatrix& m, std::int64_t j) {
        return std::span<double>(m.value).subspan(index(j * m.rows), index(m.rows));
    };
    for (std::int64_t j = 0; j < a.columns; ++j) {
        for (int pass = 0; pass < 2; ++pass)
            for (std::int64_t i = 0; i < j; ++i) {
                const double share = -dot(column(a, i), column(a, j));
                add_scaled(share, column(a, i), column(a, j));
                add_scaled(share, column(with, i), column(with, j));
            }
        const double norm = std::sqrt(dot(column(a, j), column(a, j)));
        for (double& v : column(a, j)) v /= norm;
        for (double& v : column(with, j)) v /= norm;
    }
}

Eigen eigen_symmetric(DenseMatrix a) {
    Eigen result{std::vector<double>(index(a.rows)), std::move(a)};
    const int n = blas_size(result.vector.rows), lda = leading(result.vector);
    if (n == 0) return result;
    int info = 0, query = -1;
    double size = 0.0;
    blas::syev("V", "L", &n, result.vector.value.data(), &lda, result.value.data(), &size, &query, &info);
    const int lwork = static_cast<int>(size);
    std::vector<double> work(index(lwork));
    blas::syev("V", "L", &n, result.vector.value.data(), &lda, result.value.data(), work.data(), &lwork, &info);
    if (info != 0) fail(DELAM_ERROR_NUMERICAL, "the eigenvalues of a block of ", n, " rows did not converge");
    return result;
}

PivotedColumns pivoted_columns(DenseMatrix a, double tolerance) {
    const int m = blas_size(a.rows), lda = leading(a);
    if (a.columns > 2000000000)
        fail(DELAM_ERROR_MEMORY, "too many columns in a rank-revealing factorisation: ", a.columns);
    const int n = static_cast<int>(a.columns);
    PivotedColumns result{std::vector<std::int64_t>(index(n)), 0};
    if (m == 0 || n == 0) {
        std::iota(result.order.begin(), result.order.end(), std::int64_t{0});
        return result;
    }
    std::vector<int> pivot(index(n), 0);
    std::vector<double> tau(index(std::min(m, n)));
    int info = 0, query = -1;
    double size = 0.0;
    blas::geqp3(&m, &n, a.value.data(), &lda, pivot.data(), tau.data(), &size, &query, &info);
    const int lwork = static_cast<int>(size);
    std::vector<double> work(index(lwork));
    blas::geqp3(&m, &n, a.value.data(), &lda, pivot.data(), tau.data(), work.data(), &lwork, &info);
    for (int j = 0; j < n; ++j) result.order[index(j)] = pivot[index(j)] - 1;
    const double largest = std::abs(a(0, 0));
    for (int j = 0; j < std::min(m, n); ++j)
        if (std::abs(a(j, j)) > tolerance * largest) result.rank = j + 1;
    return result;
}

bool solve_general(DenseMatrix& a, DenseMatrix& b, double tolerance) {
    const int n = blas_size(a.rows), lda = leading(a), columns = blas_size(b.columns);
    if (n == 0) return true;
    for (std::int64_t i = 0; i < a.rows; ++i) {
        double largest = 0.0;
        for (std::int64_t j = 0; j < a.columns; ++j) largest = std::max(largest, std::abs(a(i, j)));
        if (!(largest > 0.0)) return false;
        for (std::int64_t j = 0; j < a.columns; ++j) a(i, j) /= largest;
        for (std::int64_t j = 0; j < b.columns; ++j) b(i, j) /= largest;
    }
    std::vector<int> pivot(index(n));
    int info = 0;
    blas::getrf(&n, &n, a.value.data(), &lda, pivot.data(), &info);
    double least = std::numeric_limits<double>::infinity(), most = 0.0;
    for (std::int64_t i = 0; i < a.rows; ++i) {
        least = std::min(least, std::abs(a(i, i)));
        most = std::max(most, std::abs(a(i, i)));
    }
    if (info != 0 || !(least > tolerance * most)) return false;
    blas::getrs("N", &n, &columns, a.value.data(), &lda, pivot.data(), b.value.data(), &lda, &info);
    return true;
}

}  // namespace delam
