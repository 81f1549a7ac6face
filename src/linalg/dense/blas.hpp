// SPDX-License-Identifier: BSD-3-Clause
// BLAS and LAPACK by name, each call on one thread of the BLAS (base/blas_threads.hpp). Arguments are those of the
// Fortran routines.
#pragma once

#include "base/machine/blas_threads.hpp"

extern "C" {
void dsymv_(const char*, const int*, const double*, const double*, const int*, const double*, const int*, const double*,
            double*, const int*);
void dgemm_(const char*, const char*, const int*, const int*, const int*, const double*, const double*, const int*,
            const double*, const int*, const double*, double*, const int*);
void dsyrk_(const char*, const char*, const int*, const int*, const double*, const double*, const int*, const double*,
            double*, const int*);
void dtrsv_(const char*, const char*, const char*, const int*, const double*, const int*, double*, const int*);
void dtrsm_(const char*, const char*, const char*, const char*, const int*, const int*, const double*, const double*,
            const int*, double*, const int*);
void dgemv_(const char*, const int*, const int*, const double*, const double*, const int*, const double*, const int*,
            const double*, double*, const int*);
void dpotrf_(const char*, const int*, double*, const int*, int*);
void dpotri_(const char*, const int*, double*, const int*, int*);
void dtrmm_(const char*, const char*, const char*, const char*, const int*, const int*, const double*, const double*,
            const int*, double*, const int*);
void dtrtri_(const char*, const char*, const int*, double*, const int*, int*);
void dlauum_(const char*, const int*, double*, const int*, int*);
void dgetrf_(const int*, const int*, double*, const int*, int*, int*);
void dgetrs_(const char*, const int*, const int*, const double*, const int*, const int*, double*, const int*, int*);
void dsyev_(const char*, const char*, const int*, double*, const int*, double*, double*, const int*, int*);
void dgeqp3_(const int*, const int*, double*, const int*, int*, double*, double*, const int*, int*);
}

namespace delam::blas {

inline void symv(const char* uplo, const int* n, const double* alpha, const double* a, const int* lda, const double* x,
                 const int* incx, const double* beta, double* y, const int* incy) {
    const BlasThreads one;
    dsymv_(uplo, n, alpha, a, lda, x, incx, beta, y, incy);
}
inline void gemv(const char* trans, const int* m, const int* n, const double* alpha, const double* a, const int* lda,
                 const double* x, const int* incx, const double* beta, double* y, const int* incy) {
    const BlasThreads one;
    dgemv_(trans, m, n, alpha, a, lda, x, incx, beta, y, incy);
}
inline void trsv(const char* uplo, const char* trans, const char* diag, const int* n, const double* a, const int* lda,
                 double* x, const int* incx) {
    const BlasThreads one;
    dtrsv_(uplo, trans, diag, n, a, lda, x, incx);
}
inline void gemm(const char* ta, const char* tb, const int* m, const int* n, const int* k, const double* alpha,
                 const double* a, const int* lda, const double* b, const int* ldb, const double* beta, double* c,
                 const int* ldc) {
    const BlasThreads one;
    dgemm_(ta, tb, m, n, k, alpha, a, lda, b, ldb, beta, c, ldc);
}
inline void syrk(const char* uplo, const char* trans, const int* n, const int* k, const double* alpha, const double* a,
                 const int* lda, const double* beta, double* c, const int* ldc) {
    const BlasThreads one;
    dsyrk_(uplo, trans, n, k, alpha, a, lda, beta, c, ldc);
}
inline void trsm(const char* side, const char* uplo, const char* trans, const char* diag, const int* m, const int* n,
                 const double* alpha, const double* a, const int* lda, double* b, const int* ldb) {
    const BlasThreads one;
    dtrsm_(side, uplo, trans, diag, m, n, alpha, a, lda, b, ldb);
}
inline void trmm(const char* side, const char* uplo, const char* trans, const char* diag, const int* m, const int* n,
                 const double* alpha, const double* a, const int* lda, double* b, const int* ldb) {
    const BlasThreads one;
    dtrmm_(side, uplo, trans, diag, m, n, alpha, a, lda, b, ldb);
}
inline void potrf(const char* uplo, const int* n, double* a, const int* lda, int* info) {
    const BlasThreads one;
    dpotrf_(uplo, n, a, lda, info);
}
inline void potri(const char* uplo, const int* n, double* a, const int* lda, int* info) {
    const BlasThreads one;
    dpotri_(uplo, n, a, lda, info);
}
inline void trtri(const char* uplo, const char* diag, const int* n, double* a, const int* lda, int* info) {
    const BlasThreads one;
    dtrtri_(uplo, diag, n, a, lda, info);
}
inline void lauum(const char* uplo, const int* n, double* a, const int* lda, int* info) {
    const BlasThreads one;
    dlauum_(uplo, n, a, lda, info);
}
inline void getrf(const int* m, const int* n, double* a, const int* lda, int* pivot, int* info) {
    const BlasThreads one;
    dgetrf_(m, n, a, lda, pivot, info);
}
inline void getrs(const char* trans, const int* n, const int* columns, const double* a, const int* lda,
                  const int* pivot, double* b, const int* ldb, int* info) {
    const BlasThreads one;
    dgetrs_(trans, n, columns, a, lda, pivot, b, ldb, info);
}
inline void syev(const char* job, const char* uplo, const int* n, double* a, const int* lda, double* w, double* work,
                 const int* lwork, int* info) {
    const BlasThreads one;
    dsyev_(job, uplo, n, a, lda, w, work, lwork, info);
}
inline void geqp3(const int* m, const int* n, double* a, const int* lda, int* pivot, double* tau, double* work,
                  const int* lwork, int* info) {
    const BlasThreads one;
    dgeqp3_(m, n, a, lda, pivot, tau, work, lwork, info);
}

}  // namespace delam::blas
