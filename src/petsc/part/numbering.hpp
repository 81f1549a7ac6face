// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/numbers.hpp"
#include "petsc/base/communicator.hpp"

namespace delam::petsc {

// PETSc's numbers of the nodes. A node belongs to the lowest rank whose part has it as no ghost, nodes of the mesh
// without any part to rank 0; the nodes of a rank have consecutive numbers, in the order of the mesh. No rank knows the
// numbers of all nodes: node n is written down on rank n / share, where the others ask for it. All calls are
// collective.
class Numbering {
public:
    // nodes: of this rank's part, without ghosts, which are other ranks'. mesh_nodes: how many the mesh has.
    Numbering(const Communicator& comm, std::span<const std::int64_t> nodes, std::int64_t mesh_nodes);

    PetscInt first() const { return first_; }
    PetscInt owned() const { return owned_; }
    // Nodes of the mesh without any part; empty but on rank 0.
    const std::vector<std::int64_t>& orphans() const { return orphans_; }
    std::vector<PetscInt> find(std::span<const std::int64_t> nodes) const;

private:
    std::vector<std::vector<std::int64_t>> by_keeper(std::span<const std::int64_t> nodes) const;
    std::size_t keeper(std::int64_t node) const { return index(node / share_); }

    const Communicator& comm_;
    std::int64_t share_ = 1;
    PetscInt first_ = 0;
    PetscInt owned_ = 0;
    std::vector<std::int64_t> orphans_;
    std::vector<PetscInt> number_;  // of the nodes that this rank has written down; -1: nobody has them
};

}  // namespace delam::petsc
