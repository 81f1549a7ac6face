// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/base/failure.hpp"

#include <new>

namespace delam::petsc {

namespace {

// PETSc's handlers are a stack of the process; ours writes here, in the thread that runs PETSc.
thread_local std::string recorded;

PetscErrorCode record(MPI_Comm, int line, const char* function, const char*, PetscErrorCode code, PetscErrorType type,
                      const char* text, void*) {
    // A library below PETSc may have failed first, where PETSc passes its number on.
    if (type != PETSC_ERROR_INITIAL && !recorded.empty()) return code;
    try {
        std::ostringstream all;
        all << (function != nullptr ? function : "PETSc") << ", line " << line << ": " << (text != nullptr ? text : "");
        recorded = all.str();
    } catch (...) {
        return code;
    }
    return code;
}

}  // namespace

ErrorRecord::ErrorRecord() {
    recorded.clear();
    PetscPushErrorHandler(record, nullptr);
}

ErrorRecord::~ErrorRecord() { PetscPopErrorHandler(); }

void fail_petsc(PetscErrorCode code) {
    const char* kind = nullptr;
    PetscErrorMessage(code, &kind, nullptr);
    // Numbers that PETSc does not know are those of a library below it, as PTScotch's up to PETSc 3.18.
    std::int32_t status = kind != nullptr ? DELAM_ERROR_INTERNAL : DELAM_ERROR_NUMERICAL;
    if (code == PETSC_ERR_MEM) status = DELAM_ERROR_MEMORY;
    if (code == PETSC_ERR_FP || code == PETSC_ERR_MAT_LU_ZRPVT || code == PETSC_ERR_MAT_CH_ZRPVT ||
        code == PETSC_ERR_NOT_CONVERGED || code == PETSC_ERR_LIB)
        status = DELAM_ERROR_NUMERICAL;
    // A number out of range, or none, is one of PETSc's options: the engine's own arguments are checked before.
    if (code == PETSC_ERR_ARG_UNKNOWN_TYPE || code == PETSC_ERR_MISSING_FACTOR || code == PETSC_ERR_SUP ||
        code == PETSC_ERR_USER_INPUT || code == PETSC_ERR_ARG_OUTOFRANGE)
        status = DELAM_ERROR_ARGUMENT;
    // MUMPS' solve says it in words: -13 is an allocation that failed, -9 and -8 are work arrays that are too small.
    for (const char* memory : {"INFOG(1)=-13", "INFOG(1)=-9", "INFOG(1)=-8"})
        if (recorded.find(memory) != std::string::npos) status = DELAM_ERROR_MEMORY;
    if (kind == nullptr)
        fail(status, "PETSc: a library below it returned ", static_cast<int>(code), " (", recorded, ")");
    fail(status, "PETSc: ", kind, " (", recorded, ")");
}

Failure current_failure() {
    try {
        throw;
    } catch (const Failure& failure) {
        return failure;
    } catch (const std::bad_alloc&) {
        return Failure(DELAM_ERROR_MEMORY, "not enough memory");
    } catch (const std::length_error&) {
        return Failure(DELAM_ERROR_MEMORY, "not enough memory: more entries than an array can have");
    } catch (const std::exception& error) {
        return Failure(DELAM_ERROR_INTERNAL, error.what());
    } catch (...) {
        return Failure(DELAM_ERROR_INTERNAL, "an unknown exception");
    }
}

PetscErrorCode failed_in_callback() {
    try {
        recorded = current_failure().what();
    } catch (...) {
        recorded.clear();
    }
    return PETSC_ERR_LIB;
}

}  // namespace delam::petsc
