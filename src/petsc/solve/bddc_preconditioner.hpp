// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "petsc/bodies/displacement_system.hpp"
#include "petsc/solve/inner_preconditioner.hpp"

namespace delam::petsc {

// BDDC (C. Dohrmann, Numer. Linear Algebra Appl. 14 (2007) 149-168; S. Zampini, SIAM J. Sci. Comput. 38 (2016)
// S282-S306): B on the ranks' own matrices in the displacements w, and P^-1 B P^-T in the variables v. Stiff springs
// then tie neighbouring nodes of a rank, which its own factor resolves.
class BddcPreconditioner final : public InnerPreconditioner {
public:
    BddcPreconditioner(const Bodies& bodies, const Visible& visible, const SceneVariables& scene);

    double renew(const Operator::Entries& entries) override;
    void apply(Vec residual, Vec z) const override;

private:
    void give_coordinates();

    const Bodies& bodies_;
    DisplacementSystem system_;
    OwnedIs corners_;
    OwnedMat matrix_;
    OwnedPc bddc_;
    bool has_coordinates_ = false;
    OwnedVec residual_, z_;
};

}  // namespace delam::petsc
