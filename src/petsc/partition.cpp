// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/partition.hpp"

#include <algorithm>
#include <set>

#include "petsc/glued_cells.hpp"
#include "petsc/options.hpp"

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

std::vector<std::uint8_t> part_bytes(const delam_problem* problem, const std::vector<std::int64_t>& cells) {
    if (cells.empty()) return {};
    std::int64_t size = 0;
    const auto count = static_cast<std::int64_t>(cells.size());
    std::int32_t status = delam_experimental_problem_part(problem, count, cells.data(), 0, nullptr, &size);
    std::vector<std::uint8_t> bytes;
    if (status == DELAM_OK) {
        bytes.resize(static_cast<std::size_t>(size));
        status = delam_experimental_problem_part(problem, count, cells.data(), size, bytes.data(), &size);
    }
    if (status != DELAM_OK)
        fail(status, "delam_experimental_problem_part returned ", delam_status_name(status),
             " (delam_context_message on rank 0 says why)");
    return bytes;
}

Part part_of_bytes(std::int32_t dimension, const std::vector<std::uint8_t>& bytes) {
    if (bytes.empty()) return make_part(dimension, 0, nullptr, nullptr, nullptr, nullptr, nullptr);
    struct Context {
        delam_context* handle = nullptr;
        ~Context() { delam_context_destroy(&handle); }
    } context;
    std::int64_t dimensions = 0, nodes = 0, entries = 0;
    const auto size = static_cast<std::int64_t>(bytes.size());
    std::vector<std::int64_t> node, start, column;
    std::vector<double> place, value;
    const auto call = [&](bool all) {
        const std::int32_t status = delam_experimental_part_matrix(
            context.handle, size, bytes.data(), &dimensions, &nodes, &entries, all ? node.data() : nullptr,
            all ? place.data() : nullptr, all ? start.data() : nullptr, all ? column.data() : nullptr,
            all ? value.data() : nullptr);
        if (status != DELAM_OK) fail(status, "delam_experimental_part_matrix: ", delam_context_message(context.handle));
    };
    if (delam_context_create(&context.handle) != DELAM_OK) fail(DELAM_ERROR_MEMORY, "not enough memory");
    call(false);
    node.resize(static_cast<std::size_t>(nodes));
    place.resize(static_cast<std::size_t>(nodes * dimensions));
    start.resize(static_cast<std::size_t>(nodes * dimensions) + 1);
    column.resize(static_cast<std::size_t>(entries));
    value.resize(static_cast<std::size_t>(entries));
    call(true);
    return make_part(static_cast<std::int32_t>(dimensions), nodes, node.data(), place.data(), start.data(),
                     column.data(), value.data());
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
    for (std::size_t c = 0; c < rank.size(); ++c)
        rank[c] = static_cast<int>(part[static_cast<std::size_t>(graph.vertex[c])]);
    check(ISRestoreIndices(parts, &part));
    return rank;
}

namespace {

// A body without cells has its stiffness from the host, which no part carries.
void require_cells(const delam_mesh* mesh) {
    std::int64_t nodes = 0, cells = 0;
    if (delam_mesh_size(mesh, nullptr, &nodes, &cells, nullptr, nullptr) != DELAM_OK) return;
    std::vector<std::int32_t> of_node(static_cast<std::size_t>(nodes)), of_cell(static_cast<std::size_t>(cells)),
        types(of_cell.size());
    std::vector<std::int64_t> offsets(of_cell.size() + 1);
    std::int64_t entries = 0;
    const std::int32_t first = delam_mesh_node_bodies(mesh, nodes, of_node.data()),
                       second =
                           delam_mesh_cells(mesh, types.data(), of_cell.data(), offsets.data(), 0, nullptr, &entries);
    if (first != DELAM_OK || second != DELAM_OK) fail(DELAM_ERROR_PROBLEM, "mesh: its bodies cannot be read");
    const std::set<std::int32_t> with_cells(of_cell.begin(), of_cell.end());
    for (const std::int32_t body : of_node)
        if (body >= 0 && !with_cells.contains(body))
            fail(DELAM_ERROR_PROBLEM, "body ", body,
                 " has no cells: hand over its stiffness by parts (delam_petsc_set_part) instead of the scene");
}

// Nothing but from rank 0.
std::vector<std::vector<std::int64_t>> outgoing(const Communicator& comm,
                                                std::vector<std::vector<std::int64_t>> lists) {
    comm.together([&] { lists.resize(static_cast<std::size_t>(comm.size())); });
    return lists;
}

}  // namespace

ReceivedPart receive_part(const Communicator& comm, const delam_mesh* mesh, const delam_problem* problem) {
    std::vector<std::vector<std::int64_t>> cells;
    std::int32_t dimension = 0;
    comm.together([&] {
        if (!comm.root()) return;
        if (const std::int32_t status = delam_mesh_size(mesh, &dimension, nullptr, nullptr, nullptr, nullptr);
            status != DELAM_OK)
            fail(status, "mesh: ", delam_status_name(status));
        require_cells(mesh);
        const std::vector<int> rank = partition_cells(mesh, comm.size());
        cells.resize(static_cast<std::size_t>(comm.size()));
        for (std::size_t c = 0; c < rank.size(); ++c)
            cells[static_cast<std::size_t>(rank[c])].push_back(static_cast<std::int64_t>(c));
    });
    comm.broadcast(dimension);
    // One rank after the other, so that rank 0 holds the bytes of one part at a time.
    ReceivedPart received;
    std::vector<std::uint8_t>& mine = received.cells.bytes;
    for (int r = comm.size() - 1; r >= 0; --r) {
        std::vector<std::uint8_t> bytes;
        comm.together([&] {
            if (comm.root()) bytes = part_bytes(problem, cells[static_cast<std::size_t>(r)]);
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
