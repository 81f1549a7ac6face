// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "petsc/solve/operator.hpp"

namespace delam::petsc {

// An approximate inverse of T^T K T + E, where E are the entries of `renew`. All calls are collective.
class InnerPreconditioner {
public:
    InnerPreconditioner() = default;
    virtual ~InnerPreconditioner() = default;
    InnerPreconditioner(const InnerPreconditioner&) = delete;
    InnerPreconditioner& operator=(const InnerPreconditioner&) = delete;

    // entries: on rank 0. Returns how many iterations this is worth.
    virtual double renew(const Operator::Entries& entries) = 0;
    virtual void apply(Vec residual, Vec z) const = 0;
    virtual double factor_entries() const { return 0.0; }
    virtual double factor_flops() const { return 0.0; }
};

// Sets the preconditioner up, and fails if PETSc says that it cannot.
void set_up(PC pc);
// Returns the worth of a renewal where nothing tells; -delam_renewal_worth.
double usual_worth();

}  // namespace delam::petsc
