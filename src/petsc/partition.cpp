// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/partition.hpp"

#include <algorithm>

#include "base/numbers.hpp"
#include "petsc/base/options.hpp"
#include "petsc/part/cell_bytes.hpp"
#include "petsc/part/glued_cells.hpp"

namespace delam::petsc {

namespace {

using OwnedPartitioning = Owned<MatPartitioning, MatPartitioningDestroy>;

// PETSc frees these with the graph.
PetscInt* petsc_array(const std::vector<std::int64_t>& values) {
    PetscInt* array = nullptr;
    check(PetscMalloc1(std::max<std::size_t>(1, values.size()), &array));
    for (std::size_t i = 0; i < values.size(); ++i) array[i] = petsc_int(values[i]);
    return array;
}

}  // namespace

std::vector<int> partition_cells(const delam_mesh* mesh, int ranks) {
    const GluedCells graph = glue_cells(mesh);
    std::vector<int> rank(graph.vertex.size(), 0);
    if (ranks == 1 || rank.empty()) return rank;
    const PetscInt vertices = petsc_int(graph.cells.size());
    OwnedMat matrix;
    check(MatCreateMPIAdj(PETSC_COMM_SELF, vertices, vertices, petsc_array(graph.start), petsc_array(graph.neighbour),
                          nullptr, matrix.out()));
    OwnedPartitioning partitioning;
    check(MatPartitioningCreate(PETSC_COMM_SELF, partitioning.out()));
    check(PetscObjectSetOptionsPrefix(reinterpret_cast<PetscObject>(static_cast<MatPartitioning>(partitioning)),
                                      options_prefix));
    check(MatPartitioningSetAdjacency(partitioning, matrix));
    check(MatPartitioningSetNParts(partitioning, ranks));
    check(MatPartitioningSetVertexWeights(partitioning, petsc_array(graph.cells)));
    check(MatPartitioningSetType(partitioning, MATPARTITIONINGPTSCOTCH));
    check(MatPartitioningSetFromOptions(partitioning));
    OwnedIs parts;
    check(MatPartitioningApply(partitioning, parts.out()));
    const PetscInt* part = nullptr;
    check(ISGetIndices(parts, &part));
    for (std::size_t c = 0; c < rank.size(); ++c) rank[c] = static_cast<int>(part[index(graph.vertex[c])]);
    check(ISRestoreIndices(parts, &part));
    return rank;
}

namespace {

std::vector<int> checked(const GivenRanks& given, const delam_mesh* mesh, int size) {
    std::int64_t cells = 0;
    if (const std::int32_t status = delam_mesh_size(mesh, nullptr, nullptr, &cells, nullptr, nullptr);
        status != DELAM_OK)
        fail(status, "mesh: ", delam_status_name(status));
    const auto& [count, rank] = given;
    if (count != cells) fail(DELAM_ERROR_ARGUMENT, "cell_count = ", count, ", but the mesh has ", cells, " cells");
    if (count > 0 && rank == nullptr) fail(DELAM_ERROR_ARGUMENT, "ranks: NULL with ", count, " cells");
    for (std::int64_t c = 0; c < count; ++c)
        if (rank[c] < 0 || rank[c] >= size)
            fail(DELAM_ERROR_ARGUMENT, "ranks: ", rank[c], " of cell ", c, " is not in [0, ", size, ")");
    return {rank, rank + count};
}

// Returns the lists of rank 0; the other ranks send nothing.
std::vector<std::vector<std::int64_t>> outgoing(const Communicator& comm,
                                                std::vector<std::vector<std::int64_t>> lists) {
    comm.together([&] { lists.resize(index(comm.size())); });
    return lists;
}

}  // namespace

ReceivedPart receive_part(const Communicator& comm, const delam_mesh* mesh, const delam_problem* problem,
                          const GivenRanks* given) {
    std::vector<std::vector<std::int64_t>> cells;
    std::int32_t dimension = 0;
    comm.together([&] {
        if (!comm.root()) return;
        if (const std::int32_t status = delam_mesh_size(mesh, &dimension, nullptr, nullptr, nullptr, nullptr);
            status != DELAM_OK)
            fail(status, "mesh: ", delam_status_name(status));
        require_cells(mesh);
        const std::vector<int> rank =
            given != nullptr ? checked(*given, mesh, comm.size()) : partition_cells(mesh, comm.size());
        cells.resize(index(comm.size()));
        for (std::size_t c = 0; c < rank.size(); ++c) cells[index(rank[c])].push_back(static_cast<std::int64_t>(c));
    });
    comm.broadcast(dimension);
    // One rank after the other, so that rank 0 holds the bytes of one part at a time.
    ReceivedPart received;
    std::vector<std::uint8_t>& mine = received.cells.bytes;
    for (int r = comm.size() - 1; r >= 0; --r) {
        std::vector<std::uint8_t> bytes;
        comm.together([&] {
            if (comm.root()) bytes = part_bytes(problem, cells[index(r)], 0);
        });
        if (r == 0 && comm.root())
            mine = std::move(bytes);
        else if (comm.root())
            comm.send(r, bytes);
        else if (comm.rank() == r)
            mine = comm.receive();
    }
    received.cells.cells = comm.exchange(outgoing(comm, std::move(cells)))[0];
    comm.together([&] { received.part = part_of_bytes(dimension, mine); });
    return received;
}

}  // namespace delam::petsc
