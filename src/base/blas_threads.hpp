// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace delam {

// Threads of the BLAS that this process has loaded: OpenBLAS, BLIS or MKL; 0: another one, which does not say.
std::int32_t blas_threads();

}  // namespace delam
