// SPDX-License-Identifier: BSD-3-Clause
// Room for libraries that do not come back when they get none (src/capi/CONTRACT.md, "Memory"): it is asked for
// beforehand, where a refusal is an exception.
#pragma once

#include <cstddef>

namespace delam {

// Throws std::bad_alloc unless so much can be had at once; it is given back.
void require_room(std::size_t bytes);

// Lets OpenBLAS take its working memory, once in a process. Throws std::bad_alloc if there is no room for it.
void prepare_blas();

}  // namespace delam
