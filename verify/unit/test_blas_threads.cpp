// SPDX-License-Identifier: BSD-3-Clause
// Calls of the BLAS have one thread, and the host's number is restored, whatever overlaps.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>
#include <vector>

#include <dlfcn.h>
#include <sys/stat.h>

#include "base/machine/blas_memory.hpp"
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
int openblas_get_parallel() __attribute__((weak));
void daxpy_(const int*, const double*, const double*, const int*, double*, const int*);
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

std::int64_t threads_of_the_process() {
    struct stat tasks {};
    return stat("/proc/self/task", &tasks) == 0 ? static_cast<std::int64_t>(tasks.st_nlink) - 2 : 0;
}

// True once the process has that many threads: Linux lists a thread that has been joined for a moment longer.
bool has_threads(std::int64_t number) {
    for (int k = 0; k < 1000 && threads_of_the_process() != number; ++k)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return threads_of_the_process() == number;
}

// Large enough for OpenBLAS to share it.
void work_of_the_host() {
    std::vector<double> x(std::size_t{1} << 20, 1.0);
    const int size = 1 << 20, one = 1;
    const double a = 0.5;
    daxpy_(&size, &a, x.data(), &one, x.data(), &one);
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

// Its threads would take a tenth of a second of another processor; once started they stay, so the count at the end
// tells that none was.
TEST(a_small_analysis_starts_no_thread) {
    if (!host_wants(2) || openblas_get_parallel == nullptr || openblas_get_parallel() != 1) return;
    work_of_the_host();
    // OpenBLAS starts as many as the process has ever asked for: 2, or 3 after another test in the same process.
    const std::int64_t shared = threads_of_the_process();
    ck_assert_int_gt(shared, 1);
    prepare_blas();
    ck_assert(has_threads(1));
    ck_assert_int_eq(openblas_get_num_threads(), 2);
    const Problem problem = unit::make_flexure({});
    Monitor monitor;
    Solver solver(problem, monitor, 0.0);
    for (int k = 1; k <= 8; ++k) {
        ck_assert_int_ge(solver.advance(k / 8.0).status, 0);
        solver.commit();
    }
    ck_assert(has_threads(1));
    // A host whose work is shared has its threads again.
    work_of_the_host();
    ck_assert_int_eq(openblas_get_num_threads(), 2);
    ck_assert(has_threads(shared));
}

// They may be at work for another thread of the host: then nothing ends them.
TEST(threads_stay_where_the_host_has_others) {
    if (!host_wants(2) || openblas_get_parallel == nullptr || openblas_get_parallel() != 1) return;
    work_of_the_host();
    const std::int64_t shared = threads_of_the_process();
    std::atomic<bool> over{false};
    std::thread other([&] {
        while (!over) std::this_thread::yield();
    });
    prepare_blas();
    const std::int64_t threads = threads_of_the_process();
    over = true;
    other.join();
    ck_assert_int_gt(shared, 1);
    ck_assert_int_eq(threads, shared + 1);
}
