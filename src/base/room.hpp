// SPDX-License-Identifier: BSD-3-Clause
// Tests for free memory before calls into libraries that do not return when an allocation fails (src/capi/CONTRACT.md,
// "Memory"). Here a failure is an exception.
#pragma once

#include <cstddef>

namespace delam {

// Allocates and frees a block of this size. Throws std::bad_alloc if it is not available.
void require_room(std::size_t bytes);
// The same in parts of this size, for a library that takes its memory in parts: the heap may hold a part although it
// has no block of the whole size, and the other way round.
void require_room(std::size_t bytes, std::size_t part);

}  // namespace delam
