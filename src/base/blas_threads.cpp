// SPDX-License-Identifier: BSD-3-Clause
#include "base/blas_threads.hpp"

#include <algorithm>

// Weak symbols: the process decides at its start which BLAS libblas.so.3 is, and only OpenBLAS, BLIS and MKL define
// them.
extern "C" {
int openblas_get_num_threads() __attribute__((weak));
int MKL_Get_Max_Threads() __attribute__((weak));
long bli_thread_get_num_threads() __attribute__((weak));
}

namespace delam {

std::int32_t blas_threads() {
    if (openblas_get_num_threads != nullptr) return openblas_get_num_threads();
    if (MKL_Get_Max_Threads != nullptr) return MKL_Get_Max_Threads();
    if (bli_thread_get_num_threads != nullptr)
        return static_cast<std::int32_t>(std::max(0L, bli_thread_get_num_threads()));
    return 0;
}

}  // namespace delam
