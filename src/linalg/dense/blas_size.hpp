// SPDX-License-Identifier: BSD-3-Clause
// Sizes for BLAS and LAPACK, which have 32-bit integers.
#pragma once

#include <cstdint>
#include <limits>

#include "base/error.hpp"
#include "delam/delam.h"

namespace delam {

// Throws DELAM_ERROR_MEMORY where n does not fit: a block with so many rows should not be dense.
inline int blas_size(std::int64_t n) {
    if (n < 0 || n > std::numeric_limits<int>::max())
        fail(DELAM_ERROR_MEMORY, "a dense block of ", n, " rows is too large");
    return static_cast<int>(n);
}

}  // namespace delam
