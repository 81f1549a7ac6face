// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/solve/preconditioner.hpp"

#include <cstring>
#include <utility>

#include "petsc/base/options.hpp"
#include "petsc/solve/assembled_preconditioner.hpp"
#include "petsc/solve/bddc_preconditioner.hpp"

namespace delam::petsc {

namespace {

bool bddc_is_chosen() {
    char type[64] = "";
    check(PetscOptionsGetString(nullptr, options_prefix, "-pc_type", type, sizeof type, nullptr));
    return std::strcmp(type, PCBDDC) == 0;
}

}  // namespace

Preconditioner::Preconditioner(const Bodies& bodies, const Visible& visible, const Constraints& constraints,
                               const SceneVariables& scene)
    : constraints_(constraints), work_(bodies.vector()) {
    const bool bddc = bddc_is_chosen();
    if (bddc && bodies.part().of_rows)
        fail(DELAM_ERROR_ARGUMENT,
             "-delam_pc_type bddc needs the stiffness of each rank's own cells, which rows of the assembled stiffness "
             "(delam_petsc_set_rows) do not tell: hand over parts or cells, or take another preconditioner");
    if (bddc)
        inner_ = std::make_unique<BddcPreconditioner>(bodies, visible, scene);
    else
        inner_ = std::make_unique<AssembledPreconditioner>(bodies, visible);
}

double Preconditioner::renew(const Operator::Entries& entries) {
    ready_ = false;
    expected_ = nullptr;
    const double worth = inner_->renew(entries);
    ready_ = true;
    return worth;
}

void Preconditioner::apply(Vec residual, Vec z) const {
    if (!ready_) fail(DELAM_ERROR_STATE, "there is no preconditioner: renew comes before solve");
    last_residual_ = residual;
    last_z_ = z;
    if (expected_ != nullptr) {
        check(VecCopy(std::exchange(expected_, nullptr), z));
        return;
    }
    check(VecPointwiseMult(work_, residual, constraints_.free()));
    inner_->apply(work_, z);
    constraints_.mask(z);
}

}  // namespace delam::petsc
