// SPDX-License-Identifier: BSD-3-Clause
// Facts about the library: version, commit, binary interface, names of statuses.
#include "base/machine/blas_threads.hpp"
#include "delam/delam.h"
#include "delam_commit.h"

const char* delam_version(void) { return DELAM_VERSION_TEXT; }

const char* delam_commit(void) { return DELAM_COMMIT_TEXT; }

int32_t delam_abi(void) { return DELAM_ABI; }

int32_t delam_blas_threads(void) { return delam::blas_threads(); }

const char* delam_status_name(int32_t status) {
#define DELAM_NAME(status) \
    case status:           \
        return #status
    switch (status) {
        DELAM_NAME(DELAM_OK);
        DELAM_NAME(DELAM_NOT_CONVERGED);
        DELAM_NAME(DELAM_CANCELLED);
        DELAM_NAME(DELAM_LIMIT);
        DELAM_NAME(DELAM_ERROR_ARGUMENT);
        DELAM_NAME(DELAM_ERROR_HANDLE);
        DELAM_NAME(DELAM_ERROR_MESH);
        DELAM_NAME(DELAM_ERROR_PROBLEM);
        DELAM_NAME(DELAM_ERROR_STATE);
        DELAM_NAME(DELAM_ERROR_MEMORY);
        DELAM_NAME(DELAM_ERROR_NUMERICAL);
        DELAM_NAME(DELAM_ERROR_SNAPSHOT);
        DELAM_NAME(DELAM_ERROR_INTERNAL);
        DELAM_NAME(DELAM_ERROR_FILE);
        default:
            return "unknown status";
    }
#undef DELAM_NAME
}
