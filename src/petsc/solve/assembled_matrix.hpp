// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "petsc/bodies/bodies.hpp"

namespace delam::petsc {

// T^T K T, assembled; places without a variable have the stiffness of their DOF on the diagonal.
OwnedMat assembled_matrix(const Bodies& bodies);

}  // namespace delam::petsc
