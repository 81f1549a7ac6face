// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/solve/solve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace delam::petsc {

namespace {

constexpr double rounding_bound = RestartLimits{}.restart_rounding_units * std::numeric_limits<double>::epsilon();

}  // namespace

Solve::Solve(const Bodies& bodies, const Visible& visible, const Constraints& constraints, const Operator& matrix,
             const Preconditioner& preconditioner)
    : bodies_(bodies),
      visible_(visible),
      constraints_(constraints),
      operator_(matrix),
      preconditioner_(preconditioner),
      iterations_(bodies, matrix, preconditioner) {
    for (OwnedVec* vector :
         {&recursion_, &right_, &rest_, &v_, &av_, &cv_, &r_, &z_, &x_, &work_, &best_, &best_z_, &largest_})
        *vector = bodies.vector();
}

// Begins with known answers, times the factor that has the least energy: a load that has only grown needs nothing else.
// With v = s S y + r0:  s = y.S^T(b - A r0) / y.S^T A S y.
void Solve::begin(const Question& question, const KeptStates& kept) {
    visible_.write(question.force, right_);
    bodies_.add_loads(question.theta, right_);
    constraints_.rest(question.right, rest_);
    check(VecCopy(rest_, v_));
    if (question.start.empty()) return;
    residual(question);  // r = S^T(b - A r0)
    kept.combine(question.start, x_);
    constraints_.mask(x_);
    PetscScalar pull = 0.0, curvature = 0.0;
    check(VecDot(x_, r_, &pull));
    operator_.apply(x_, cv_);
    check(VecDot(x_, cv_, &curvature));
    if (!std::isfinite(pull) || !std::isfinite(curvature)) return;
    constraints_.spread(x_, av_);
    check(VecAXPY(v_, curvature > 0.0 ? pull / curvature : 1.0, av_));
}

double Solve::residual(const Question& question) {
    operator_.apply_bodies(v_, av_);
    operator_.apply_couplings(v_, cv_);
    const double size = std::sqrt(std::abs(bodies_.stored(question.theta, v_, av_)) + operator_.coupled(v_));
    check(VecCopy(right_, work_));
    check(VecAXPY(work_, -1.0, av_));
    check(VecAXPY(work_, -1.0, cv_));
    constraints_.gather(work_, r_);
    return size;
}

double Solve::precondition() {
    preconditioner_.apply(r_, z_);
    PetscScalar product = 0.0;
    check(VecDot(r_, z_, &product));
    return std::sqrt(std::abs(product));
}

void Solve::residual_sizes(const Question& question) {
    bodies_.sizes(bodies_.state(question.theta, v_), work_);
    operator_.add_coupling_sizes(v_, work_);
    PetscInt count = 0;
    PetscScalar* sizes = nullptr;
    const PetscScalar* right = nullptr;
    check(VecGetLocalSize(work_, &count));
    check(VecGetArrayRead(right_, &right));
    check(VecGetArray(work_, &sizes));
    for (PetscInt i = 0; i < count; ++i) sizes[i] += std::abs(right[i]);
    check(VecRestoreArray(work_, &sizes));
    check(VecRestoreArrayRead(right_, &right));
}

// Each component of the residual has an error of the size of its largest terms times the rounding unit, with a random
// sign.
double Solve::rounding(const Question& question) {
    residual_sizes(question);
    PetscInt count = 0;
    PetscScalar* sizes = nullptr;
    check(VecGetLocalSize(work_, &count));
    check(VecGetArray(work_, &sizes));
    std::uint64_t seed = 1 + static_cast<std::uint64_t>(bodies_.comm().rank());
    for (PetscInt i = 0; i < count; ++i) {
        seed = seed * 6364136223846793005u + 1442695040888963407u;
        if ((seed >> 63U) == 0) sizes[i] = -sizes[i];
    }
    check(VecRestoreArray(work_, &sizes));
    constraints_.gather(work_, cv_);
    preconditioner_.apply(cv_, av_);
    PetscScalar product = 0.0;
    check(VecDot(cv_, av_, &product));
    return std::numeric_limits<double>::epsilon() * std::sqrt(std::abs(product));
}

bool Solve::largest_rounding(const Question& question) {
    if (constraints_.has_pivots()) return false;
    residual_sizes(question);
    check(VecCopy(work_, largest_));
    check(VecScale(largest_, rounding_bound));
    return true;
}

// The finest tolerances ask for all that rounding leaves. Where a spring has become softer than in the preconditioner,
// M takes little notice of the residual there (a contact that opens, with a tension of 2e-6 of the largest: 3.5e-12 of
// the state, less than a fifth of its rounding): hence no component may be larger than its rounding.
bool Solve::asks_for_all(const Restarts& restarts) {
    return restarts.tolerance() <= std::max(finest_tolerance, restarts.rounded());
}

// True if the true residual r is that of the recursion, but for what rounding does to each component.
bool Solve::confirms(const Question& question, Vec recursion) {
    if (constraints_.has_pivots()) return false;
    residual_sizes(question);
    PetscInt count = 0;
    const PetscScalar *sizes = nullptr, *known = nullptr, *own = nullptr, *free = nullptr;
    check(VecGetLocalSize(work_, &count));
    check(VecGetArrayRead(work_, &sizes));
    check(VecGetArrayRead(recursion, &known));
    check(VecGetArrayRead(r_, &own));
    check(VecGetArrayRead(constraints_.free(), &free));
    double differing = 0.0;
    for (PetscInt i = 0; i < count; ++i)
        if (free[i] != 0.0 && !(std::abs(own[i] - known[i]) <= rounding_bound * sizes[i])) differing = 1.0;
    check(VecRestoreArrayRead(work_, &sizes));
    check(VecRestoreArrayRead(recursion, &known));
    check(VecRestoreArrayRead(r_, &own));
    check(VecRestoreArrayRead(constraints_.free(), &free));
    return bodies_.comm().sum(differing) == 0.0;
}

// One run of the recursion from the residual r. True: nothing more to do. Leaves the true residual in r and returns the
// size of the state; where the recursion has reached the target and its residual is the true one, its M r is taken
// over.
bool Solve::iterate(const Question& question, const Restarts& restarts, double& size, Result& result) {
    Iterations::Limits limits{restarts.goal(), nullptr, question.limit - result.iterations, question.poll,
                              question.user};
    if (asks_for_all(restarts) && largest_rounding(question)) limits.largest = largest_;
    check(VecCopy(r_, recursion_));
    const Iterations::Outcome outcome = iterations_.run(recursion_, z_, x_, limits);
    result.iterations += outcome.iterations;
    result.least = std::min(result.least, outcome.least);
    result.definite = outcome.definite;
    result.cancelled = outcome.cancelled;
    if (!outcome.definite || outcome.cancelled) return true;
    constraints_.spread(x_, cv_);
    check(VecAXPY(v_, 1.0, cv_));
    size = residual(question);
    if (!restarts.may_end() || !outcome.reached || !confirms(question, recursion_)) return false;
    const double left = restarts.left(outcome.norm, size);
    if (!restarts.accepts(left, size)) return false;
    check(VecCopy(v_, best_));
    constraints_.spread(z_, best_z_);
    if (outcome.norm > 0.0) check(VecScale(best_z_, left / outcome.norm));
    result.norm = left;
    result.size = size;
    result.converged = true;
    return true;
}

Result Solve::rounds(const Question& question) {
    const Communicator& comm = bodies_.comm();
    Result result;
    double tolerance = question.tolerance;  // of rank 0, which alone has the question
    comm.broadcast(tolerance);
    Restarts restarts(tolerance, rounded_);
    double size = residual(question);
    while (true) {
        const double norm = precondition();
        if (!std::isfinite(norm)) fail(DELAM_ERROR_NUMERICAL, "the residual is not finite");
        restarts.begin(norm, size);
        if (restarts.first()) {
            result.first = norm;
            double enough =
                comm.root() && question.enough != nullptr && norm > 0.0 ? question.enough(norm, question.user) : 0.0;
            comm.broadcast(enough);
            restarts.allow(enough);
        }
        if (restarts.needs_rounding()) restarts.set_rounded(rounding(question) / size);
        rounded_ = restarts.rounded();
        bool reached = restarts.reached();
        if (reached && restarts.first() && asks_for_all(restarts) && largest_rounding(question))
            reached = within(comm, r_, largest_);
        if (restarts.best()) {
            result.norm = norm;
            result.size = size;
            check(VecCopy(v_, best_));
            constraints_.spread(z_, best_z_);
        }
        std::int64_t over = !reached && question.limit <= result.iterations ? 1 : 0;
        comm.broadcast(over);
        if (reached || over != 0 || restarts.over()) {
            result.converged = reached || restarts.excused();
            return result;
        }
        if (iterate(question, restarts, size, result)) return result;
    }
}

Result Solve::run(const Question& question, const KeptStates& kept) {
    begin(question, kept);
    return rounds(question);
}

}  // namespace delam::petsc
