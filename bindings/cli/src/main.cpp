// SPDX-License-Identifier: BSD-3-Clause
#include "descriptors.hpp"
#include "program.hpp"

int main(int argc, char** argv) {
    cli::open_standard_descriptors();
    return cli::program(argc, argv, {});
}
