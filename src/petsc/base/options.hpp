// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

namespace delam::petsc {

// Prefix of all our objects in PETSc's database.
inline constexpr const char* options_prefix = "delam_";

// Initialises PETSc if nobody has; it is then finalised with MPI.
void start_petsc(MPI_Comm comm);
// Sets an option of ours (its name without the prefix) unless the user has.
void default_option(const char* name, const char* value);

}  // namespace delam::petsc
