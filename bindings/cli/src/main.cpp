// SPDX-License-Identifier: BSD-3-Clause
#include "blas_kernels.hpp"
#include "command/line/program.hpp"
#include "file/descriptors.hpp"

int main(int argc, char** argv) {
    cli::choose_blas_kernels(argv);
    cli::open_standard_descriptors();
    return cli::program(argc, argv, {});
}
