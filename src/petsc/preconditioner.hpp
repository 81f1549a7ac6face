// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <utility>

#include "petsc/operator.hpp"

namespace delam::petsc {

// What approximates the inverse of the bodies' matrix with the entries of `renew`; between the two masks of the free
// variables it is the preconditioner M. PETSc's options with the prefix delam_ choose it: -delam_pc_type and so on.
class Preconditioner {
public:
    Preconditioner(const Bodies& bodies, const Visible& visible, const Constraints& constraints);
    Preconditioner(const Preconditioner&) = delete;
    Preconditioner& operator=(const Preconditioner&) = delete;

    // Returns how many iterations this is worth.
    double renew(const Operator::Entries& entries);
    void apply(Vec residual, Vec z) const;
    // The next residual that apply gets has this z, which is known.
    void expect(Vec z) const { expected_ = z; }

    double factor_entries() const { return factor_entries_; }
    double factor_flops() const { return factor_flops_; }

private:
    void create();
    void add_entries(const Operator::Entries& entries);
    void complete_diagonal();
    void set_up();
    double worth();

    const Bodies& bodies_;
    const Visible& visible_;
    const Constraints& constraints_;
    OwnedMat matrix_;
    std::map<std::pair<PetscInt, PetscInt>, double> places_;  // all that there ever were, on rank 0
    SparseEntries entries_;
    OwnedPc inner_;
    OwnedVec work_;
    double factor_entries_ = 0.0;
    double factor_flops_ = 0.0;
    mutable Vec expected_ = nullptr;
};

}  // namespace delam::petsc
