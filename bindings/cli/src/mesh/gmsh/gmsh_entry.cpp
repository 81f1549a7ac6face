// SPDX-License-Identifier: BSD-3-Clause
// What the module of Gmsh shows to the program.
#include "mesh/gmsh/gmsh_module.hpp"
#include "mesh/gmsh/read_gmsh.hpp"

extern "C" __attribute__((visibility("default"))) const cli::GmshModule delam_gmsh_module;
const cli::GmshModule delam_gmsh_module{DELAM_PROGRAM_VERSION, cli::read_gmsh, cli::generate_fibre_cell,
                                        cli::generate_weave};
