// SPDX-License-Identifier: BSD-3-Clause
// The functions of the module of Gmsh that the program calls.
#include "mesh/gmsh/gmsh_module.hpp"
#include "mesh/gmsh/read_gmsh.hpp"

extern "C" __attribute__((visibility("default"))) const cli::GmshModule delam_gmsh_module;
const cli::GmshModule delam_gmsh_module{DELAM_PROGRAM_VERSION, cli::read_gmsh, cli::gmsh_elements,
                                        cli::generate_fibre_cell, cli::generate_weave};
