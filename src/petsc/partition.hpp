// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "delam/experimental.h"
#include "petsc/base/communicator.hpp"
#include "petsc/bodies/part_state.hpp"
#include "petsc/part/part.hpp"

namespace delam::petsc {

// Cells of a mesh that stay together: the rank of each in [0, ranks). Cells on both sides of a paired face have the
// same rank, so that no cut runs along an interface.
std::vector<int> partition_cells(const delam_mesh* mesh, int ranks);

// A host's own partition: [count] the rank of each cell.
struct GivenRanks {
    std::int64_t count = 0;
    const std::int32_t* rank = nullptr;
};

struct ReceivedPart {
    Part part;
    PartCells cells;
};

// Rank 0's mesh and problem (NULL elsewhere), divided as `given` says there or else by partition_cells; returns what
// falls to this rank. Collective.
ReceivedPart receive_part(const Communicator& comm, const delam_mesh* mesh, const delam_problem* problem,
                          const GivenRanks* given);

}  // namespace delam::petsc
