// SPDX-License-Identifier: BSD-3-Clause
// Calls of the BLAS have one thread, and the host's number is restored, whatever overlaps.
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <thread>

#include <dlfcn.h>

#include "base/machine/blas_threads.hpp"
#include "base/monitor.hpp"
#include "check.hpp"
#include "evolution/analysis/solver.hpp"
#include "flexure.hpp"
#include "linalg/dense/blas.hpp"
#include "linalg/dense/dense.hpp"

extern "C" {
int openblas_get_num_threads() __attribute__((weak));
void openblas_set_num_threads(int) __attribute__((weak));
}

using namespace delam;

namespace {

// Calls of dpotrf_ below, and the most threads that the BLAS has had in them.
std::atomic<int> calls{0}, most{0};

// False: another BLAS, or one without threads.
bool host_wants(int threads) {
    if (openblas_get_num_threads == nullptr || openblas_set_num_threads == nullptr) return false;
    openblas_set_num_threads(threads);
    return openblas_get_num_threads() == threads;
}

}  // namespace

// In the place of LAPACK's, which does the work.
void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info) {
    using Potrf = void (*)(const char*, const int*, double*, const int*, int*);
    static const auto next = reinterpret_cast<Potrf>(dlsym(RTLD_NEXT, "dpotrf_"));
    ++calls;
    if (openblas_get_num_threads != nullptr) most = std::max(most.load(), openblas_get_num_threads());
    next(uplo, n, a, lda, info);
}

TEST(one_thread_meanwhile) {
    if (!host_wants(3)) return;
    {
        const BlasThreads outer;
        ck_assert_int_eq(openblas_get_num_threads(), 1);
        ck_assert_int_eq(blas_threads(), 3);  // number that the host has set
        const BlasThreads inner;
        ck_assert_int_eq(openblas_get_num_threads(), 1);
    }
    ck_assert_int_eq(openblas_get_num_threads(), 3);
    ck_assert(host_wants(1));
    {
        const BlasThreads one;
        ck_assert_int_eq(openblas_get_num_threads(), 1);
    }
    ck_assert_int_eq(openblas_get_num_threads(), 1);
}

// The first to come is the first to go: the other one still needs one thread.
TEST(threads_that_overlap) {
    if (!host_wants(2)) return;
    std::atomic<int> stage{0};
    std::thread other([&] {
        const BlasThreads one;
        stage = 1;
        while (stage != 2) std::this_thread::yield();
    });
    while (stage != 1) std::this_thread::yield();
    {
        const BlasThreads one;
        stage = 2;
        other.join();
        ck_assert_int_eq(openblas_get_num_threads(), 1);
    }
    ck_assert_int_eq(openblas_get_num_threads(), 2);
}

TEST(one_thread_for_good) {
    if (!host_wants(2)) return;
    {
        const BlasThreads one;
        leave_blas_one_thread();
        ck_assert_int_eq(blas_threads(), 1);
    }
    ck_assert_int_eq(openblas_get_num_threads(), 1);
    ck_assert(host_wants(2));
    leave_blas_one_thread();
    ck_assert_int_eq(openblas_get_num_threads(), 1);
}

// An analysis has the bits of one with one thread of the BLAS, and leaves the host's number.
TEST(an_analysis_leaves_the_number) {
    if (!host_wants(2)) return;
    const Problem problem = unit::make_flexure({});
    const auto analyse = [&] {
        Monitor monitor;
        Solver solver(problem, monitor, 0.0);
        for (int k = 1; k <= 4; ++k) {
            ck_assert_int_ge(solver.advance(k / 4.0).status, 0);
            solver.commit();
        }
        return solver.states().shown().adhesion;
    };
    calls = most = 0;
    const std::vector<double> two = analyse();
    ck_assert_int_eq(openblas_get_num_threads(), 2);
    ck_assert_int_gt(calls, 0);
    ck_assert_int_eq(most, 1);
    ck_assert(host_wants(1));
    ck_assert(analyse() == two);
}
