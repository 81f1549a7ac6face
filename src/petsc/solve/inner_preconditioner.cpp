// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/solve/inner_preconditioner.hpp"

#include <algorithm>

#include "petsc/base/options.hpp"

namespace delam::petsc {

void set_up(PC pc) {
    check(PCSetUp(pc));
    PCFailedReason reason = PC_NOERROR;
    check(PCGetFailedReason(pc, &reason));
    if (reason == PC_NOERROR) return;
    check(PCReset(pc));
    fail(reason == PC_FACTOR_OUTMEMORY ? DELAM_ERROR_MEMORY : DELAM_ERROR_NUMERICAL,
         "the preconditioner cannot be set up: ", PCFailedReasons[reason]);
}

double usual_worth() {
    PetscReal worth = 20.0;
    check(PetscOptionsGetReal(nullptr, options_prefix, "-renewal_worth", &worth, nullptr));
    return std::max(1.0, static_cast<double>(worth));
}

}  // namespace delam::petsc
