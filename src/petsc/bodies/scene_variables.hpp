// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "delam/experimental.h"
#include "petsc/base/communicator.hpp"

namespace delam::petsc {

// The data of delam_experimental_variables that all ranks know. Each variable is called by the DOF whose place it has,
// its "home": a DOF that is a variable is its own home, a jump has a replaced DOF. A replaced DOF that is nobody's home
// has no variable.
struct SceneVariables {
    struct Terms {  // of a load pattern
        std::vector<std::int64_t> dof;
        std::vector<double> value;
    };

    std::int64_t dimension = 0;
    std::int64_t dofs = 0;
    std::vector<std::int64_t> replaced;  // ascending
    std::vector<std::uint8_t> is_home;   // of the replaced ones
    std::vector<std::int64_t> start;
    std::vector<std::int64_t> home;  // of the variable of an entry
    std::vector<double> coefficient;
    std::vector<Terms> lift;
    std::vector<Terms> force;
    std::vector<std::int64_t> visible;  // homes; on rank 0 only

    std::size_t patterns() const { return lift.size(); }
    // Place of a DOF in `replaced`, or -1.
    std::int64_t place(std::int64_t dof) const;
};

// Collective; variables is NULL but on rank 0, which has checked none of it.
SceneVariables share_variables(const Communicator& comm, const delam_experimental_variables* variables);

}  // namespace delam::petsc
