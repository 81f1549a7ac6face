// SPDX-License-Identifier: BSD-3-Clause
// OpenBLAS has a block of addresses as working memory for each thread that computes at the same time, its own or a
// caller's. It asks for ever for a block that the system refuses, and whoever waits for that thread waits too. It never
// gives a block back. So the library checks for room before a thread asks.
#pragma once

#include <cstdint>

namespace delam {

// Reserves the memory of the BLAS for one caller and its threads, which then rest (blas_threads.hpp). Where there may
// be no room for all of them, the BLAS computes with one thread from then on; throws std::bad_alloc if there is none
// even for one. Does nothing with libraries other than OpenBLAS.
void prepare_blas();

// The number of callers, from 1 to `wanted`, for which there is memory when they use the BLAS at the same time.
std::int64_t blas_callers(std::int64_t wanted);

}  // namespace delam
