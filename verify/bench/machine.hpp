// SPDX-License-Identifier: BSD-3-Clause
// The machine and software on which the figures were measured, and the memory that this process has used.
#pragma once

#include <string>

#include "stats.hpp"

namespace bench {

// Processor, cores, kernel, compiler, library and commit, BLAS and the kernels and threads it chose, load, date.
Json machine();

double peak_memory();  // bytes, VmHWM
// Resets the peak to the present use; false if the kernel does not allow it.
bool reset_peak_memory();

}  // namespace bench
