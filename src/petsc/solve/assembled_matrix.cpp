// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/solve/assembled_matrix.hpp"
#include "base/numbers.hpp"

#include <algorithm>

namespace delam::petsc {

namespace {

// Returns the diagonal where the congruence leaves nothing. Places without a variable, which no vector ever uses, get
// the stiffness of their DOF, so that the matrix is definite and its entries are of one size; variables of other ranks
// get a zero.
std::vector<double> missing_diagonal(const LocalMatrix& stiffness, const LocalVariables& local) {
    std::vector<double> own(index(local.places()), 0.0);
    double typical = 0.0;
    for (std::size_t r = 0; r < index(stiffness.rows); ++r)
        for (auto e = index(stiffness.start[r]); e < index(stiffness.start[r + 1]); ++e)
            if (index(stiffness.column[e]) == r) typical = std::max(typical, own[r] = stiffness.value[e]);
    for (std::size_t i = 0; i < own.size(); ++i) {
        if (local.is_variable[i] != 0)
            own[i] = 0.0;
        else if (!(own[i] > 0.0))
            own[i] = typical > 0.0 ? typical : 1.0;
    }
    return own;
}

}  // namespace

OwnedMat assembled_matrix(const Bodies& bodies) {
    const Communicator& comm = bodies.comm();
    const LocalVariables& local = bodies.local();
    LocalMatrix places;
    comm.together([&] {
        LocalMatrix& stiffness = const_cast<LocalMatrix&>(bodies.part().stiffness);  // PETSc's arrays have no const
        LocalMatrix transform = local.transform;
        transform.rows = stiffness.rows;  // those of orphans have no stiffness
        const OwnedMat k = stiffness.borrow(), t = transform.borrow();
        OwnedMat product;
        check(MatPtAP(k, t, MAT_INITIAL_MATRIX, PETSC_DEFAULT, product.out()));
        places = with_diagonal(product, missing_diagonal(stiffness, local));
    });
    OwnedMapping mapping;
    check(ISLocalToGlobalMappingCreate(comm.get(), 1, local.places(), local.number.data(), PETSC_COPY_VALUES,
                                       mapping.out()));
    OwnedMat unassembled, matrix;
    check(MatCreateIS(comm.get(), 1, local.owned, local.owned, PETSC_DETERMINE, PETSC_DETERMINE, mapping, mapping,
                      unassembled.out()));
    const OwnedMat borrowed = places.borrow();
    check(MatISSetLocalMat(unassembled, borrowed));
    check(MatAssemblyBegin(unassembled, MAT_FINAL_ASSEMBLY));
    check(MatAssemblyEnd(unassembled, MAT_FINAL_ASSEMBLY));
    check(MatConvert(unassembled, MATAIJ, MAT_INITIAL_MATRIX, matrix.out()));
    check(MatSetOption(matrix, MAT_SYMMETRIC, PETSC_TRUE));
    return matrix;
}

}  // namespace delam::petsc
