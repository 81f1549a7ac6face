// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <string>

#include <petscsys.h>

#include "delam/delam.h"

namespace delam::petsc {

// Ends a call that cannot do its work: a status of delam.h and the reason.
struct Failure : std::runtime_error {
    Failure(std::int32_t which, const std::string& text) : std::runtime_error(text), status(which) {}
    std::int32_t status;
};

template <class... Parts>
[[noreturn]] void fail(std::int32_t status, const Parts&... parts) {
    std::ostringstream text;
    (text << ... << parts);
    throw Failure(status, text.str());
}

// PETSc's errors are recorded instead of printed while this object exists.
class ErrorRecord {
public:
    ErrorRecord();
    ~ErrorRecord();
    ErrorRecord(const ErrorRecord&) = delete;
    ErrorRecord& operator=(const ErrorRecord&) = delete;
};

[[noreturn]] void fail_petsc(PetscErrorCode code);
inline void check(PetscErrorCode code) {
    if (code != 0) fail_petsc(code);
}

// The status and text of the exception that is being handled.
Failure current_failure();
// Inside a function that PETSc calls, where no exception may pass: keeps the text of the exception that is being
// handled for fail_petsc, and returns what the function returns.
PetscErrorCode failed_in_callback();

// PETSc counts in PetscInt, which has 32 bits unless PETSC was configured otherwise.
template <class Integer>
PetscInt petsc_int(Integer value) {
    if (static_cast<std::int64_t>(value) > static_cast<std::int64_t>(PETSC_MAX_INT))
        fail(DELAM_ERROR_ARGUMENT, value, " is more than PETSc's integers hold; it has to be configured with 64 bits");
    return static_cast<PetscInt>(value);
}

}  // namespace delam::petsc
