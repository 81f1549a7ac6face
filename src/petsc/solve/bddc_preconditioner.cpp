// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/solve/bddc_preconditioner.hpp"

#include <string>
#include <utility>
#include <vector>

#include "base/numbers.hpp"
#include "petsc/base/options.hpp"
#include "petsc/solve/corners.hpp"

namespace delam::petsc {

namespace {

bool has_cholmod() {
    PetscBool type = PETSC_FALSE, matrix = PETSC_FALSE;
    PetscErrorCode (*create)(Mat, MatFactorType, Mat*) = nullptr;
    check(MatSolverTypeGet(MATSOLVERCHOLMOD, MATSEQAIJ, MAT_FACTOR_CHOLESKY, &type, &matrix, &create));
    return type == PETSC_TRUE && matrix == PETSC_TRUE && create != nullptr;
}

}  // namespace

BddcPreconditioner::BddcPreconditioner(const Bodies& bodies, const Visible& visible, const SceneVariables& scene)
    : bodies_(bodies), system_(bodies, visible, scene), residual_(bodies.vector()), z_(bodies.vector()) {
    // Thin layers need the means over faces, and parts that debonding has cut off constraints of their own.
    default_option("pc_bddc_use_faces", "true");
    default_option("pc_bddc_detect_disconnected", "true");
    const double lacking = bodies.part().coordinates.empty() && !bodies.part().nodes.empty() ? 1.0 : 0.0;
    has_coordinates_ = bodies.comm().sum(lacking) == 0.0;
    const std::vector<PetscInt> points = corners(bodies, system_, has_coordinates_);
    check(ISCreateGeneral(bodies.comm().get(), petsc_int(points.size()), points.data(), PETSC_COPY_VALUES,
                          corners_.out()));
    // CHOLMOD's factors of one rank take half of MUMPS' memory, and half of the time.
    MatSolverType local = has_cholmod() ? MATSOLVERCHOLMOD : MATSOLVERMUMPS;
    for (const auto& [solver, factors] :
         {std::pair{"dirichlet", local}, {"neumann", local}, {"coarse", MATSOLVERMUMPS}}) {
        const std::string name = std::string("pc_bddc_") + solver;
        default_option((name + "_pc_type").c_str(), "cholesky");
        default_option((name + "_pc_factor_mat_solver_type").c_str(), factors);
        default_option((name + "_mat_mumps_icntl_14").c_str(), "60");
    }
}

// Makes BDDC anew each time, because its constraints depend on what springs connect.
double BddcPreconditioner::renew(const Operator::Entries& entries) {
    const LocalVariables& local = bodies_.local();
    bddc_.reset();
    LocalMatrix stiffness;
    std::vector<PetscInt> start, column;
    bodies_.comm().together([&] {
        stiffness = system_.stiffness();
        start = stiffness.start;
        column = stiffness.column;
    });
    const OwnedMat own = system_.local_matrix(std::move(stiffness), entries.rows, entries.columns, entries.values);
    check(MatCreateIS(bodies_.comm().get(), local.dimension, local.owned, local.owned, PETSC_DETERMINE, PETSC_DETERMINE,
                      system_.mapping(), system_.mapping(), matrix_.out()));
    check(MatISSetLocalMat(matrix_, own));
    check(MatAssemblyBegin(matrix_, MAT_FINAL_ASSEMBLY));
    check(MatAssemblyEnd(matrix_, MAT_FINAL_ASSEMBLY));
    check(MatSetOption(matrix_, MAT_SYMMETRIC, PETSC_TRUE));
    check(MatSetOption(matrix_, MAT_SPD, PETSC_TRUE));
    check(PCCreate(bodies_.comm().get(), bddc_.out()));
    check(PCSetOptionsPrefix(bddc_, options_prefix));
    check(PCSetOperators(bddc_, matrix_, matrix_));
    check(PCSetType(bddc_, PCBDDC));
    check(PCSetFromOptions(bddc_));
    check(PCBDDCSetDirichletBoundariesLocal(bddc_, system_.empty_places()));
    check(PCBDDCSetPrimalVerticesIS(bddc_, corners_));
    // Constraints for each body that crosses a cut, also where springs tie it to another: in contact they only resist
    // one component.
    check(PCBDDCSetLocalAdjacencyGraph(bddc_, petsc_int(start.size()) - 1, start.data(), column.data(),
                                       PETSC_COPY_VALUES));
    start = column = {};
    give_coordinates();
    set_up(bddc_);
    return usual_worth();
}

// One point for each place that this rank owns.
void BddcPreconditioner::give_coordinates() {
    const LocalVariables& local = bodies_.local();
    const std::vector<double>& places = bodies_.part().coordinates;
    if (!has_coordinates_) return;
    const auto d = index(local.dimension);
    std::vector<PetscReal> points;
    bodies_.comm().together([&] {
        points.assign(index(local.owned) * d, 0.0);
        for (std::size_t i = 0; i < bodies_.part().nodes.size() * d; ++i)
            for (std::size_t c = 0; c < d && local.owns(i); ++c)
                points[index(local.number[i] - local.first) * d + c] = places[i / d * d + c];
    });
    check(PCSetCoordinates(bddc_, local.dimension, local.owned, points.data()));
}

void BddcPreconditioner::apply(Vec residual, Vec z) const {
    check(MatMultTranspose(system_.expansion(), residual, residual_));
    check(PCApply(bddc_, residual_, z_));
    check(MatMult(system_.expansion(), z_, z));
}

}  // namespace delam::petsc
