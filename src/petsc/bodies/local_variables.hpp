// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "petsc/base/local_matrix.hpp"
#include "petsc/bodies/scene_variables.hpp"
#include "petsc/part/numbering.hpp"
#include "petsc/part/part.hpp"

namespace delam::petsc {

// This rank's rows of u = T v + U theta. Its nodes are those of its part, then, on rank 0, those that no part has, then
// those whose variables the rows of the others contain. Each node has a place for each component, which holds the
// variable at home there or, where there is none, nothing: a zero, so that all nodes have blocks of one size.
struct LocalVariables {
    struct Terms {
        std::vector<PetscInt> dof;  // places
        std::vector<double> value;
    };

    PetscInt dimension = 0;
    PetscInt dofs = 0;  // rows of T: those of the part and of orphans
    std::vector<std::int64_t> nodes;
    std::vector<PetscInt> number;           // PETSc's, of each place
    std::vector<std::uint8_t> is_variable;  // of each place
    std::vector<std::uint8_t> is_jump;      // likewise
    PetscInt first = 0;                     // of the places that this rank owns
    PetscInt owned = 0;
    LocalMatrix transform;     // T
    std::vector<Terms> lift;   // U, by pattern
    std::vector<Terms> force;  // at the places that this rank owns

    PetscInt places() const { return transform.columns; }
    bool owns(std::size_t place) const { return number[place] >= first && number[place] < first + owned; }
};

LocalVariables make_local_variables(const Communicator& comm, const Part& part, const SceneVariables& scene,
                                    const Numbering& numbering);

}  // namespace delam::petsc
