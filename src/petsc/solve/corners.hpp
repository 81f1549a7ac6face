// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "petsc/bodies/displacement_system.hpp"

namespace delam::petsc {

// PETSc's numbers of DOFs at which BDDC keeps the ranks together: for each body of this rank and each neighbour that it
// touches, nodes far from each other, as many as hold it as a rigid body. The local matrix without them is then regular
// whatever springs there are; in contact, for example, these only resist one component, and nothing in the matrix says
// that the bodies may slide.
std::vector<PetscInt> corners(const Bodies& bodies, const DisplacementSystem& system, bool has_coordinates);

}  // namespace delam::petsc
