// SPDX-License-Identifier: BSD-3-Clause
// How many threads the BLAS uses. Its threads wait for each other by spinning: where other programs use the cores, a
// small product waits for a time slice of each of them. So small work is done by one thread, whatever the host has set.
#pragma once

#include <cstdint>

namespace delam {

// Number of threads of the BLAS loaded by this process (OpenBLAS, BLIS or MKL); 0: another BLAS, which cannot tell.
std::int32_t blas_threads();

// While it lives, BLAS calls of this thread use one thread, if the work is small; large work gets as many as the host
// has set. OpenBLAS and BLIS know one number for the whole process: calls of BLAS that the host makes in other threads
// meanwhile may have one thread, too. The host's number is restored once no thread of the library needs it to be one.
class BlasThreads {
public:
    // Multiplications of one call. Below `large` (20 ms of one core) a second thread would gain less than it may wait.
    static constexpr double large = 2e8;
    explicit BlasThreads(double multiplications);
    ~BlasThreads();
    BlasThreads(const BlasThreads&) = delete;
    BlasThreads& operator=(const BlasThreads&) = delete;

private:
    bool alone_ = false;
    std::int32_t before_ = 0;  // of this thread, where the BLAS knows one number for each
};

// The host's number becomes one, for as long as the process lives.
void leave_blas_one_thread();

}  // namespace delam
