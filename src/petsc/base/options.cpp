// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/base/options.hpp"

#include <string>

#include <petscsys.h>

#include "petsc/base/failure.hpp"

namespace delam::petsc {

namespace {

// MPI deletes the attributes of MPI_COMM_SELF first of all when it is finalised, and still works then.
int finalize(MPI_Comm, int, void*, void*) {
    PetscBool done = PETSC_FALSE;
    PetscFinalized(&done);
    if (done != PETSC_TRUE) PetscFinalize();
    return MPI_SUCCESS;
}

}  // namespace

void start_petsc(MPI_Comm comm) {
    PetscBool started = PETSC_FALSE;
    PetscInitialized(&started);
    if (started != PETSC_TRUE) {
        // PETSc is initialised by all processes together; where not all take part, by these alone.
        int relation = MPI_UNEQUAL;
        MPI_Comm_compare(comm, MPI_COMM_WORLD, &relation);
        if (relation == MPI_UNEQUAL || relation == MPI_SIMILAR) MPI_Comm_dup(comm, &PETSC_COMM_WORLD);
        PetscOptionsSetValue(nullptr, "-no_signal_handler", "true");
        if (PetscInitializeNoArguments() != 0) fail(DELAM_ERROR_INTERNAL, "PETSc cannot be initialised");
        int key = MPI_KEYVAL_INVALID;
        MPI_Comm_create_keyval(MPI_COMM_NULL_COPY_FN, finalize, &key, nullptr);
        MPI_Comm_set_attr(MPI_COMM_SELF, key, nullptr);
        MPI_Comm_free_keyval(&key);
    }
    default_option("mat_mumps_icntl_14", "60");  // percent of memory above MUMPS' estimate
    default_option("mat_mumps_icntl_24", "0");   // zero pivots are errors
}

void default_option(const char* name, const char* value) {
    const std::string key = std::string("-") + options_prefix + name;
    PetscBool present = PETSC_FALSE;
    check(PetscOptionsHasName(nullptr, nullptr, key.c_str(), &present));
    if (present != PETSC_TRUE) check(PetscOptionsSetValue(nullptr, key.c_str(), value));
}

}  // namespace delam::petsc
