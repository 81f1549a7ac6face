// SPDX-License-Identifier: BSD-3-Clause
// Where and with what the figures were measured, and how much memory this process has used.
#pragma once

#include <string>

#include "stats.hpp"

namespace bench {

// Processor, cores, kernel, compiler, library and commit, BLAS and the kernels and threads it chose, load, date.
Json machine();

double peak_memory();  // bytes, VmHWM
// Sets the peak back to what is used now; false where the kernel does not allow it.
bool reset_peak_memory();

}  // namespace bench
