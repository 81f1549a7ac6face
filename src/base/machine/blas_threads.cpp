// SPDX-License-Identifier: BSD-3-Clause
#include "base/machine/blas_threads.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <mutex>

// Weak symbols: the process decides at its start which BLAS libblas.so.3 is, and only OpenBLAS, BLIS and MKL define
// them.
extern "C" {
int openblas_get_num_threads() __attribute__((weak));
void openblas_set_num_threads(int) __attribute__((weak));
int openblas_get_parallel() __attribute__((weak));
int blas_thread_shutdown_() __attribute__((weak));
extern int blas_server_avail __attribute__((weak));
extern int blas_num_threads __attribute__((weak));
extern int blas_cpu_number __attribute__((weak));
int MKL_Get_Max_Threads() __attribute__((weak));
int MKL_Set_Num_Threads_Local(int) __attribute__((weak));
long bli_thread_get_num_threads() __attribute__((weak));
void bli_thread_set_num_threads(long) __attribute__((weak));
}

namespace delam {

namespace {

std::mutex counting;
std::int64_t alone = 0;        // threads of the library that want one thread
std::int32_t of_the_host = 0;  // while they do

// True for OpenBLAS with threads of its own, 1, not those of OpenMP, 2.
bool has_own_threads() {
    return openblas_get_parallel != nullptr && openblas_get_parallel() == 1 && blas_thread_shutdown_ != nullptr &&
           &blas_server_avail != nullptr && &blas_num_threads != nullptr && &blas_cpu_number != nullptr;
}

// openblas_set_num_threads() starts threads that rest; where there are enough already, all else that it does is to note
// the number.
bool set_threads(std::int32_t threads) {
    if (has_own_threads() && threads <= blas_num_threads)
        blas_cpu_number = threads;
    else if (openblas_get_num_threads != nullptr && openblas_set_num_threads != nullptr)
        openblas_set_num_threads(threads);
    else if (bli_thread_get_num_threads != nullptr && bli_thread_set_num_threads != nullptr)
        bli_thread_set_num_threads(threads);
    else
        return false;
    return true;
}

std::int32_t threads_now() {
    if (openblas_get_num_threads != nullptr) return openblas_get_num_threads();
    if (MKL_Get_Max_Threads != nullptr) return MKL_Get_Max_Threads();
    if (bli_thread_get_num_threads != nullptr)
        return static_cast<std::int32_t>(std::max(0L, bli_thread_get_num_threads()));
    return 0;
}

}  // namespace

std::int32_t blas_threads() {
    const std::lock_guard lock(counting);
    return alone > 0 ? of_the_host : threads_now();
}

BlasThreads::BlasThreads() {
    if (MKL_Set_Num_Threads_Local != nullptr) {
        before_ = MKL_Set_Num_Threads_Local(1);
        alone_ = true;
        return;
    }
    const std::lock_guard lock(counting);
    if (alone == 0) {
        of_the_host = threads_now();
        if (of_the_host <= 1 || !set_threads(1)) return;
    }
    ++alone;
    alone_ = true;
}

BlasThreads::~BlasThreads() {
    if (!alone_) return;
    if (MKL_Set_Num_Threads_Local != nullptr) {
        MKL_Set_Num_Threads_Local(before_);
        return;
    }
    const std::lock_guard lock(counting);
    if (--alone == 0) set_threads(of_the_host);
}

// Threads of the process: a folder has a link from each of its folders, and two more.
void rest_blas_threads() {
    const std::lock_guard lock(counting);
    if (!has_own_threads() || blas_server_avail == 0) return;
    struct stat tasks {};
    if (stat("/proc/self/task", &tasks) != 0 || static_cast<std::int64_t>(tasks.st_nlink) != 2 + blas_num_threads)
        return;
    blas_thread_shutdown_();
}

void leave_blas_one_thread() {
    const std::lock_guard lock(counting);
    if (alone > 0)
        of_the_host = 1;
    else
        set_threads(1);
}

}  // namespace delam
