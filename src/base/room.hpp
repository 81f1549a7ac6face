// SPDX-License-Identifier: BSD-3-Clause
// Tests for free memory before calls into libraries that do not return when an allocation fails (src/capi/CONTRACT.md,
// "Memory"). Here a failure is an exception.
#pragma once

#include <cstddef>

namespace delam {

// Allocates and frees a block of this size. Throws std::bad_alloc if it is not available.
void require_room(std::size_t bytes);

// Makes OpenBLAS map its working memory, once per process. Throws std::bad_alloc if there is no room for it.
void prepare_blas();

}  // namespace delam
