// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/solve/assembled_preconditioner.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/costs.hpp"
#include "base/numbers.hpp"
#include "petsc/base/options.hpp"
#include "petsc/solve/assembled_matrix.hpp"

namespace delam::petsc {

namespace {}  // namespace

AssembledPreconditioner::AssembledPreconditioner(const Bodies& bodies, const Visible& visible)
    : bodies_(bodies), visible_(visible), of_bodies_(assembled_matrix(bodies)), work_(bodies.vector()) {
    check(MatDuplicate(of_bodies_, MAT_COPY_VALUES, matrix_.out()));
}

void AssembledPreconditioner::create() {
    inner_.reset();
    check(PCCreate(bodies_.comm().get(), inner_.out()));
    check(PCSetOptionsPrefix(inner_, options_prefix));
    check(MatSetOptionsPrefix(matrix_, options_prefix));
    check(PCSetOperators(inner_, matrix_, matrix_));
    PetscBool symmetric = PETSC_FALSE, general = PETSC_FALSE;
    check(MatGetFactorAvailable(matrix_, MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, &symmetric));
    check(MatGetFactorAvailable(matrix_, MATSOLVERMUMPS, MAT_FACTOR_LU, &general));
    if (symmetric == PETSC_TRUE || general == PETSC_TRUE) {
        check(PCSetType(inner_, symmetric == PETSC_TRUE ? PCCHOLESKY : PCLU));
        check(PCFactorSetMatSolverType(inner_, MATSOLVERMUMPS));
    }
    check(PCSetFromOptions(inner_));
    if (!is_direct()) give_rigid_motions();
}

// Gives multigrid the motions for its coarser levels: v of the bodies that move as one rigid body, u = T v. Jumps are
// zero then.
void AssembledPreconditioner::give_rigid_motions() {
    const LocalVariables& local = bodies_.local();
    const std::vector<double>& x = bodies_.part().coordinates;
    const double lacking = x.empty() && !bodies_.part().nodes.empty() ? 1.0 : 0.0;
    if (bodies_.comm().sum(lacking) > 0.0) return;
    // Writes f(place) at the places that this rank owns.
    const auto fill = [&local](Vec v, std::size_t places, const auto& f) {
        PetscScalar* value = nullptr;
        check(VecGetArray(v, &value));
        for (std::size_t i = 0; i < places; ++i)
            if (local.owns(i)) value[local.number[i] - local.first] = f(i, value[local.number[i] - local.first]);
        check(VecRestoreArray(v, &value));
    };
    const OwnedVec coordinates = bodies_.vector();
    fill(coordinates, x.size(), [&x](std::size_t i, double) { return x[i]; });
    Owned<MatNullSpace, MatNullSpaceDestroy> motions;
    check(MatNullSpaceCreateRigidBody(coordinates, motions.out()));
    PetscInt count = 0;
    const Vec* motion = nullptr;
    check(MatNullSpaceGetVecs(motions, nullptr, &count, &motion));
    for (PetscInt k = 0; k < count; ++k)
        fill(motion[k], index(local.places()), [&local](std::size_t i, double value) {
            return local.is_variable[i] != 0 && local.is_jump[i] == 0 ? value : 0.0;
        });
    check(MatSetBlockSize(matrix_, local.dimension));
    check(MatSetNearNullSpace(matrix_, motions));
}

double AssembledPreconditioner::renew(const Operator::Entries& entries) {
    check(MatZeroEntries(matrix_));
    check(MatAXPY(matrix_, 1.0, of_bodies_, SUBSET_NONZERO_PATTERN));
    add_entries(entries);
    complete_diagonal();
    check(MatSetOption(matrix_, MAT_SYMMETRIC, PETSC_TRUE));
    check(MatSetOption(matrix_, MAT_SPD, PETSC_TRUE));
    // A factor keeps its structure; multigrid would keep the bounds of its smoothers, which springs have changed.
    if (inner_ == nullptr || !is_direct()) create();
    check(PCSetOperators(inner_, matrix_, matrix_));
    set_up(inner_);
    return worth();
}

// The nonzero pattern only grows, so that the factor's structure is found once.
void AssembledPreconditioner::add_entries(const Operator::Entries& entries) {
    std::vector<PetscInt> rows, columns;
    std::vector<double> values;
    bodies_.comm().together([&] {
        for (auto& [place, value] : places_) value = 0.0;
        for (std::size_t e = 0; e < entries.values.size(); ++e)
            places_[{visible_.number(entries.rows[e]), visible_.number(entries.columns[e])}] += entries.values[e];
        for (const auto& [place, value] : places_) {
            rows.push_back(place.first);
            columns.push_back(place.second);
            values.push_back(value);
        }
    });
    const bool grown = entries_.set(bodies_, rows, columns, values);
    check(MatAXPY(matrix_, 1.0, entries_.matrix(), grown ? DIFFERENT_NONZERO_PATTERN : SUBSET_NONZERO_PATTERN));
}

// Some variables are acted on by neither bodies nor entries: nobody asks for them, and their rows only have to be
// regular.
void AssembledPreconditioner::complete_diagonal() {
    check(MatGetDiagonal(matrix_, work_));
    PetscReal largest = 0.0;
    check(VecNorm(work_, NORM_INFINITY, &largest));
    PetscScalar* diagonal = nullptr;
    PetscInt count = 0;
    double missing = 0.0;
    check(VecGetLocalSize(work_, &count));
    check(VecGetArray(work_, &diagonal));
    for (PetscInt i = 0; i < count; ++i) {
        const bool empty = diagonal[i] == 0.0;
        diagonal[i] = empty ? (largest > 0.0 ? largest : 1.0) : 0.0;
        missing += empty ? 1.0 : 0.0;
    }
    check(VecRestoreArray(work_, &diagonal));
    if (bodies_.comm().sum(missing) > 0.0) check(MatDiagonalSet(matrix_, work_, ADD_VALUES));
}

bool AssembledPreconditioner::is_direct() const {
    PCType type = nullptr;
    check(PCGetType(inner_, &type));
    return std::strcmp(type, PCCHOLESKY) == 0 || std::strcmp(type, PCLU) == 0;
}

double AssembledPreconditioner::worth() {
    MatSolverType solver = nullptr;
    factor_entries_ = factor_flops_ = 0.0;
    if (is_direct()) check(PCFactorGetMatSolverType(inner_, &solver));
    if (solver == nullptr || std::strcmp(solver, MATSOLVERMUMPS) != 0) return usual_worth();
    Mat factor = nullptr;
    PetscInt entries = 0;
    check(PCFactorGetMatrix(inner_, &factor));
    check(MatMumpsGetInfog(factor, 29, &entries));
    check(MatMumpsGetRinfog(factor, 3, &factor_flops_));
    // MUMPS gives numbers beyond its integers in millions, with a minus.
    factor_entries_ = entries < 0 ? -1e6 * static_cast<double>(entries) : static_cast<double>(entries);
    MatInfo info;
    check(MatGetInfo(of_bodies_, MAT_GLOBAL_SUM, &info));
    return std::max(1.0, factor_flops_ / (triangular_slowdown * (4.0 * factor_entries_ + 6.0 * info.nz_used)));
}

void AssembledPreconditioner::apply(Vec residual, Vec z) const { check(PCApply(inner_, residual, z)); }

}  // namespace delam::petsc
