// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "petsc/solve/inner_preconditioner.hpp"

namespace delam::petsc {

// The preconditioner M of the free variables: an approximate inverse of the whole matrix between two masks. PETSc's
// options with the prefix delam_ choose which; -delam_pc_type bddc works on the ranks' own matrices, every other on the
// assembled one.
class Preconditioner {
public:
    Preconditioner(const Bodies& bodies, const Visible& visible, const Constraints& constraints,
                   const SceneVariables& scene);

    // Returns how many iterations this is worth.
    double renew(const Operator::Entries& entries);
    void apply(Vec residual, Vec z) const;
    // The next residual that apply gets has this z, which is known.
    void expect(Vec z) const { expected_ = z; }
    // The last argument of apply and its answer; valid until their owner, the KSP, goes on.
    Vec last_residual() const { return last_residual_; }
    Vec last_z() const { return last_z_; }
    double factor_entries() const { return inner_->factor_entries(); }
    double factor_flops() const { return inner_->factor_flops(); }

private:
    const Constraints& constraints_;
    std::unique_ptr<InnerPreconditioner> inner_;
    bool ready_ = false;
    OwnedVec work_;
    mutable Vec expected_ = nullptr, last_residual_ = nullptr, last_z_ = nullptr;
};

}  // namespace delam::petsc
