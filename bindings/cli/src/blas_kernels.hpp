// SPDX-License-Identifier: BSD-3-Clause
// Chooses the kernels of OpenBLAS on processors that it does not know.
#pragma once

namespace cli {

// Starts the program anew with OPENBLAS_CORETYPE set, where OpenBLAS, which reads this variable as it is loaded, has
// taken kernels from before AVX2 although the processor has it: Debian 12's OpenBLAS 0.3.21 takes Intel's of 2023 and
// later for one of 2004, and an analysis in space (`delam new laminate`) takes 2.3 times as long. Returns where the
// variable is set, where the kernels suit, and where this cannot be told. To be called before anything else.
void choose_blas_kernels(char** argv);

}  // namespace cli
