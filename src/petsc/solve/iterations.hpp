// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "base/restarts.hpp"
#include "petsc/solve/operator.hpp"
#include "petsc/solve/preconditioner.hpp"

namespace delam::petsc {

// True if no component of r is larger than that of `largest`, on any rank.
bool within(const Communicator& comm, Vec r, Vec largest);

// Conjugate gradients by PETSc's KSP: corrections of a state, one run after the other. Rank 0 decides in each iteration
// whether to go on, and tells the others, so that the ranks can never part.
class Iterations {
public:
    Iterations(const Bodies& bodies, const Operator& matrix, const Preconditioner& preconditioner);
    Iterations(const Iterations&) = delete;
    Iterations& operator=(const Iterations&) = delete;

    struct Limits {             // on rank 0
        double target = 0.0;    // of sqrt(r.M r)
        Vec largest = nullptr;  // on all ranks: that each component may keep as well; nullptr: any
        std::int64_t iterations = 0;
        std::int32_t (*poll)(void* user) = nullptr;
        void* user = nullptr;
    };
    struct Outcome {
        std::int64_t iterations = 0;
        double least = 1.0;  // eigenvalue met
        bool definite = true;
        bool cancelled = false;
        double norm = 0.0;     // of the residual of the recursion
        bool reached = false;  // the target, by the recursion
    };
    // x = about A^-1 r, from zero. z: M r, which is known; if the target is reached, r and z become those of the
    // recursion at the end.
    Outcome run(Vec r, Vec z, Vec x, const Limits& limits);

private:
    void create();
    void iterate(Vec r, Vec x);
    static PetscErrorCode test(KSP ksp, PetscInt iteration, PetscReal norm, KSPConvergedReason* reason, void* self);
    KSPConvergedReason decide(PetscInt iteration, double norm);
    bool exhausted(PetscInt iteration, double norm) const;

    const Bodies& bodies_;
    const Operator& operator_;
    const Preconditioner& preconditioner_;
    OwnedPc shell_;  // of the preconditioner
    OwnedKsp ksp_;
    Limits limits_;
    Outcome outcome_;
    Lowest lowest_{RestartLimits{}.restart_noticed};
    OwnedVec residual_, z_;
    PetscInt met_ = -1;  // the iteration that met the target, but not `largest`; -1: none
};

}  // namespace delam::petsc
