// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "petsc/bodies/bodies.hpp"

namespace delam::petsc {

// Fields at all DOFs of the mesh, on rank 0, in the order of the mesh.
class MeshFields {
public:
    explicit MeshFields(const Bodies& bodies, std::int64_t dofs);

    // displacement and force [dofs] on rank 0, untouched elsewhere.
    void gather(const BodyState& state, double* displacement, double* force);

private:
    void to_root(Vec from, double* out);

    const Bodies& bodies_;
    OwnedVec field_;
    OwnedVec array_;
    OwnedScatter scatter_;
};

}  // namespace delam::petsc
