// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/part/own_cells.hpp"

#include <numeric>
#include <vector>

#include "base/numbers.hpp"
#include "petsc/base/failure.hpp"
#include "petsc/part/cell_bytes.hpp"

namespace delam::petsc {

namespace {

struct Sizes {
    std::int32_t dimension = 0;
    std::int64_t nodes = 0, cells = 0, interfaces = 0;
};

Sizes sizes_of(const delam_mesh* mesh, int rank) {
    Sizes sizes;
    const std::int32_t status =
        delam_mesh_size(mesh, &sizes.dimension, &sizes.nodes, &sizes.cells, nullptr, &sizes.interfaces);
    if (status != DELAM_OK) fail(status, "mesh of rank ", rank, ": ", delam_status_name(status));
    return sizes;
}

// Interfaces, supports and loads are those of rank 0's problem: others would act nowhere.
void require_bodies_alone(const Sizes& sizes, const delam_problem* problem, int rank) {
    if (sizes.interfaces > 0)
        fail(DELAM_ERROR_PROBLEM, "mesh of rank ", rank, ": it has ", sizes.interfaces,
             " interfaces, allowed: 0; interfaces are those of rank 0's problem");
    std::int64_t patterns = 0, constraints = 0;
    std::int32_t status = delam_problem_pattern_count(problem, &patterns);
    if (status == DELAM_OK)
        status = delam_problem_constraints(problem, &constraints, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr);
    if (status != DELAM_OK)
        fail(status, "problem of rank ", rank, ": ", delam_status_name(status),
             " (delam_context_message there says why)");
    if (patterns > 0)
        fail(DELAM_ERROR_PROBLEM, "problem of rank ", rank, ": it has ", patterns,
             " load patterns, allowed: 0; loads are those of rank 0's problem, as nodal forces or displacements");
    if (constraints > 0)
        fail(DELAM_ERROR_PROBLEM, "problem of rank ", rank, ": it has ", constraints,
             " constraints, allowed: 0; supports are those of rank 0's problem");
}

// The stiffness in the numbers of rank 0's mesh.
Part part_of_cells(const delam_mesh* mesh, const delam_problem* problem, const Sizes& sizes, std::int64_t node_count,
                   const std::int64_t* nodes, int rank) {
    if (node_count != sizes.nodes)
        fail(DELAM_ERROR_ARGUMENT, "node_count = ", node_count, ", but the mesh of rank ", rank, " has ", sizes.nodes,
             " nodes");
    (void)make_nodes(sizes.dimension, node_count, nodes, nullptr);  // also those that no cell has
    require_cells(mesh);
    require_bodies_alone(sizes, problem, rank);
    std::vector<std::int64_t> cells(index(sizes.cells));
    std::iota(cells.begin(), cells.end(), std::int64_t{0});
    Part part = part_of_bytes(sizes.dimension, part_bytes(problem, cells, rank));
    for (std::int64_t& node : part.nodes) {
        if (node >= node_count) fail(DELAM_ERROR_ARGUMENT, "mesh of rank ", rank, ": it is not that of the problem");
        node = nodes[node];
    }
    return part;
}

}  // namespace

Part make_own_cells(const Communicator& comm, const delam_mesh* mesh, const delam_problem* problem,
                    std::int64_t node_count, const std::int64_t* nodes) {
    const bool has_cells = mesh != nullptr || problem != nullptr;
    const int rank = comm.rank();
    Sizes sizes;
    comm.together([&] {
        if (has_cells && mesh == nullptr) fail(DELAM_ERROR_ARGUMENT, "mesh: NULL on rank ", rank, ", beside a problem");
        if (has_cells && problem == nullptr)
            fail(DELAM_ERROR_ARGUMENT, "problem: NULL on rank ", rank, ", beside a mesh");
        if (!has_cells && node_count != 0)
            fail(DELAM_ERROR_ARGUMENT, "node_count = ", node_count, " on rank ", rank, ", without a mesh: has to be 0");
        if (has_cells) sizes = sizes_of(mesh, rank);
    });
    const auto dimension = static_cast<std::int32_t>(comm.largest(std::int64_t{sizes.dimension}));
    Part part;
    comm.together([&] {
        if (dimension == 0) fail(DELAM_ERROR_ARGUMENT, "mesh: NULL on all ranks");
        part = has_cells ? part_of_cells(mesh, problem, sizes, node_count, nodes, rank) : part_of_bytes(dimension, {});
    });
    return part;
}

}  // namespace delam::petsc
