// SPDX-License-Identifier: BSD-3-Clause
// Limits the threads of the BLAS. These wait for each other by spinning: where other programs use the cores, a product
// waits for a time slice of each thread. So a call has one thread, whatever the host has set; threads of the library
// (team.hpp), which sleep while they wait, share large work.
#pragma once

#include <cstdint>

namespace delam {

// Number of threads of the BLAS loaded by this process (OpenBLAS, BLIS or MKL); 0: another BLAS, which cannot tell.
std::int32_t blas_threads();

// BLAS calls of this thread use one thread while this object exists. OpenBLAS and BLIS have one number of threads for
// the whole process: BLAS calls that the host makes in other threads meanwhile may have one thread, too. The host's
// number is restored once no thread of the library needs it to be one.
class BlasThreads {
public:
    BlasThreads();
    ~BlasThreads();
    BlasThreads(const BlasThreads&) = delete;
    BlasThreads& operator=(const BlasThreads&) = delete;

private:
    bool alone_ = false;
    std::int32_t before_ = 0;  // of this thread, where the BLAS knows one number for each
};

// Ends the threads of OpenBLAS if the process has no others but this one, so that nobody can be using them: they spin
// for a tenth of a second after their start and after each work. The number of threads stays, and OpenBLAS starts them
// again with the next work that it shares, as after fork().
void rest_blas_threads();

// The host's number becomes one, for as long as the process lives.
void leave_blas_one_thread();

}  // namespace delam
