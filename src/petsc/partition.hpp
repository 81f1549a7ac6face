// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "delam/experimental.h"
#include "petsc/communicator.hpp"
#include "petsc/part.hpp"
#include "petsc/part_state.hpp"

namespace delam::petsc {

// Cells of a mesh that stay together: the rank of each in [0, ranks). Cells on both sides of a paired face have the
// same rank, so that no cut runs along an interface.
std::vector<int> partition_cells(const delam_mesh* mesh, int ranks);

struct ReceivedPart {
    Part part;
    PartCells cells;
};

// Rank 0's mesh and problem (NULL elsewhere), divided; returns what falls to this rank. Collective.
ReceivedPart receive_part(const Communicator& comm, const delam_mesh* mesh, const delam_problem* problem);

}  // namespace delam::petsc
