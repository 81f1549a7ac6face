// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace delam {

// Number of threads of the BLAS loaded by this process (OpenBLAS, BLIS or MKL); 0: another BLAS, which cannot tell.
std::int32_t blas_threads();

}  // namespace delam
