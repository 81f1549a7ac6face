// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/solve/iterations.hpp"

#include <algorithm>
#include <cmath>

#include "petsc/base/options.hpp"

namespace delam::petsc {

namespace {

constexpr PetscInt longest_run = 10000;  // KSP keeps some numbers of each iteration
// Iterations beyond the target, for the components that it hides: this number at least, and one for so many of those
// before.
constexpr PetscInt most_beyond = 5;
constexpr PetscInt beyond_of = 2;

PetscErrorCode apply_shell(PC shell, Vec r, Vec z) {
    void* context = nullptr;
    const PetscErrorCode code = PCShellGetContext(shell, &context);
    if (code != 0) return code;
    try {
        static_cast<const Preconditioner*>(context)->apply(r, z);
    } catch (...) {
        return failed_in_callback();
    }
    return 0;
}

}  // namespace

bool within(const Communicator& comm, Vec r, Vec largest) {
    PetscInt count = 0;
    const PetscScalar *own = nullptr, *most = nullptr;
    check(VecGetLocalSize(r, &count));
    check(VecGetArrayRead(r, &own));
    check(VecGetArrayRead(largest, &most));
    double beyond = 0.0;
    for (PetscInt i = 0; i < count; ++i)
        if (!(std::abs(own[i]) <= most[i])) beyond = 1.0;
    check(VecRestoreArrayRead(r, &own));
    check(VecRestoreArrayRead(largest, &most));
    return comm.sum(beyond) == 0.0;
}

Iterations::Iterations(const Bodies& bodies, const Operator& matrix, const Preconditioner& preconditioner)
    : bodies_(bodies),
      operator_(matrix),
      preconditioner_(preconditioner),
      residual_(bodies.vector()),
      z_(bodies.vector()) {}

void Iterations::create() {
    check(PCCreate(bodies_.comm().get(), shell_.out()));
    check(PCSetType(shell_, PCSHELL));
    check(PCShellSetContext(shell_, const_cast<Preconditioner*>(&preconditioner_)));
    check(PCShellSetApply(shell_, apply_shell));
    check(KSPCreate(bodies_.comm().get(), ksp_.out()));
    check(KSPSetOptionsPrefix(ksp_, options_prefix));
    check(KSPSetType(ksp_, KSPCG));
    check(KSPSetPC(ksp_, shell_));
    check(KSPSetOperators(ksp_, operator_.shell(), operator_.shell()));
    // The options of the preconditioner belong to the one inside.
    check(PCSetOptionsPrefix(shell_, "delam_outer_"));
    check(KSPSetComputeSingularValues(ksp_, PETSC_TRUE));
    check(KSPSetNormType(ksp_, KSP_NORM_NATURAL));
    check(KSPSetTolerances(ksp_, 0.0, 0.0, PETSC_DEFAULT, longest_run));
    check(KSPSetFromOptions(ksp_));
    check(KSPSetNormType(ksp_, KSP_NORM_NATURAL));
    check(KSPSetInitialGuessNonzero(ksp_, PETSC_FALSE));
    check(KSPSetConvergenceTest(ksp_, test, this, nullptr));
}

PetscErrorCode Iterations::test(KSP, PetscInt iteration, PetscReal norm, KSPConvergedReason* reason, void* self) {
    try {
        *reason = static_cast<Iterations*>(self)->decide(iteration, norm);
    } catch (...) {
        return failed_in_callback();
    }
    return 0;
}

bool Iterations::exhausted(PetscInt iteration, double norm) const {
    const bool long_beyond = met_ >= 0 && iteration - met_ >= std::max(most_beyond, met_ / beyond_of);
    return iteration >= limits_.iterations || lowest_.idle() > RestartLimits{}.restart_idle || long_beyond ||
           !std::isfinite(norm);
}

KSPConvergedReason Iterations::decide(PetscInt iteration, double norm) {
    // KSPCG only sees changes of sign.
    if (iteration == 1 && met_ < 0 && operator_.last_curvature() <= 0.0) return KSP_DIVERGED_INDEFINITE_MAT;
    if (iteration == 0) lowest_ = Lowest(RestartLimits{}.restart_noticed);
    lowest_.take(norm);
    outcome_.norm = norm;
    outcome_.iterations = iteration;
    int decision = KSP_CONVERGED_ITERATING;
    if (bodies_.comm().root()) {
        if (norm <= limits_.target)
            decision = KSP_CONVERGED_ATOL;
        else if (exhausted(iteration, norm))
            decision = KSP_CONVERGED_ITS;
        else if (limits_.poll != nullptr && limits_.poll(limits_.user) != 0)
            decision = KSP_DIVERGED_BREAKDOWN;
    }
    bodies_.comm().broadcast(decision);
    if (decision == KSP_CONVERGED_ATOL && limits_.largest != nullptr &&
        !within(bodies_.comm(), preconditioner_.last_residual(), limits_.largest)) {
        if (met_ < 0) met_ = iteration;
        if (bodies_.comm().root()) decision = exhausted(iteration, norm) ? KSP_CONVERGED_ITS : KSP_CONVERGED_ITERATING;
        bodies_.comm().broadcast(decision);
    }
    outcome_.reached = decision == KSP_CONVERGED_ATOL;
    if (outcome_.reached) {
        check(VecCopy(preconditioner_.last_residual(), residual_));
        check(VecCopy(preconditioner_.last_z(), z_));
    }
    outcome_.cancelled = decision == KSP_DIVERGED_BREAKDOWN;
    return static_cast<KSPConvergedReason>(decision);
}

// A KSP is discarded after an error, because its state is then of no use.
void Iterations::iterate(Vec r, Vec x) {
    try {
        if (ksp_ == nullptr) create();
        check(KSPSolve(ksp_, r, x));
    } catch (...) {
        ksp_.reset();
        preconditioner_.expect(nullptr);
        throw;
    }
}

Iterations::Outcome Iterations::run(Vec r, Vec z, Vec x, const Limits& limits) {
    limits_ = limits;
    outcome_ = {};
    met_ = -1;
    preconditioner_.expect(z);
    iterate(r, x);
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    check(KSPGetConvergedReason(ksp_, &reason));
    PetscInt count = 0;
    check(KSPGetIterationNumber(ksp_, &count));
    outcome_.iterations = count;
    // The preconditioner is definite: if r.M r is not positive, that is rounding, and the run is over. Beyond the
    // target, a curvature is rounding, too.
    if (reason == KSP_DIVERGED_INDEFINITE_MAT && met_ < 0)
        outcome_.definite =
            !(operator_.last_curvature() <= -RestartLimits{}.restart_flat * outcome_.norm * outcome_.norm);
    if (reason == KSP_DIVERGED_PC_FAILED) fail(DELAM_ERROR_NUMERICAL, "the preconditioner has failed");
    PetscReal greatest = 0.0, least = 0.0;
    if (count > 0) check(KSPComputeExtremeSingularValues(ksp_, &greatest, &least));
    if (least > 0.0) outcome_.least = std::min(1.0, least);
    if (outcome_.reached) {
        check(VecCopy(residual_, r));
        check(VecCopy(z_, z));
    }
    return outcome_;
}

}  // namespace delam::petsc
