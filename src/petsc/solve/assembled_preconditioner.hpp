// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <utility>

#include "petsc/solve/inner_preconditioner.hpp"

namespace delam::petsc {

// The assembled matrix in the variables v, factorised (by MUMPS, if nobody says otherwise) or whatever PETSc's options
// make of it.
class AssembledPreconditioner final : public InnerPreconditioner {
public:
    AssembledPreconditioner(const Bodies& bodies, const Visible& visible);

    double renew(const Operator::Entries& entries) override;
    void apply(Vec residual, Vec z) const override;
    double factor_entries() const override { return factor_entries_; }
    double factor_flops() const override { return factor_flops_; }

private:
    void create();
    void give_rigid_motions();
    void add_entries(const Operator::Entries& entries);
    void complete_diagonal();
    bool is_direct() const;
    double worth();

    const Bodies& bodies_;
    const Visible& visible_;
    OwnedMat of_bodies_;
    OwnedMat matrix_;                                         // with entries
    std::map<std::pair<PetscInt, PetscInt>, double> places_;  // all that there ever were, on rank 0
    SparseEntries entries_;
    OwnedPc inner_;
    OwnedVec work_;
    double factor_entries_ = 0.0;
    double factor_flops_ = 0.0;
};

}  // namespace delam::petsc
