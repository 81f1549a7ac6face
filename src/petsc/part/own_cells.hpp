// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "delam/delam.h"
#include "petsc/base/communicator.hpp"
#include "petsc/part/part.hpp"

namespace delam::petsc {

// A part from a mesh and a problem of this rank's own (NULL where it has no cells). nodes: [node_count] the numbers of
// the nodes of this mesh in that of rank 0's problem. What is no stiffness (interfaces, constraints, patterns) is
// refused, because nobody would miss it. Collective.
Part make_own_cells(const Communicator& comm, const delam_mesh* mesh, const delam_problem* problem,
                    std::int64_t node_count, const std::int64_t* nodes);

}  // namespace delam::petsc
