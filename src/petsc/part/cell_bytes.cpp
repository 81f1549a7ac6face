// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/part/cell_bytes.hpp"

#include <set>

#include "base/numbers.hpp"
#include "delam/experimental.h"

namespace delam::petsc {

// A body without cells has its stiffness from the host, which no part carries.
void require_cells(const delam_mesh* mesh) {
    std::int64_t nodes = 0, cells = 0;
    if (delam_mesh_size(mesh, nullptr, &nodes, &cells, nullptr, nullptr) != DELAM_OK) return;
    std::vector<std::int32_t> of_node(index(nodes)), of_cell(index(cells)), types(of_cell.size());
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
                 " has no cells: the host hands over its stiffness by delam_petsc_set_part or delam_petsc_set_rows");
}

std::vector<std::uint8_t> part_bytes(const delam_problem* problem, const std::vector<std::int64_t>& cells, int rank) {
    if (cells.empty()) return {};
    std::int64_t size = 0;
    const auto count = static_cast<std::int64_t>(cells.size());
    std::int32_t status = delam_experimental_problem_part(problem, count, cells.data(), 0, nullptr, &size);
    std::vector<std::uint8_t> bytes;
    if (status == DELAM_OK) {
        bytes.resize(index(size));
        status = delam_experimental_problem_part(problem, count, cells.data(), size, bytes.data(), &size);
    }
    if (status != DELAM_OK)
        fail(status, "delam_experimental_problem_part returned ", delam_status_name(status),
             " (delam_context_message on rank ", rank, " says why)");
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
    node.resize(index(nodes));
    place.resize(index(nodes * dimensions));
    start.resize(index(nodes * dimensions) + 1);
    column.resize(index(entries));
    value.resize(index(entries));
    call(true);
    return make_part(static_cast<std::int32_t>(dimensions), nodes, node.data(), place.data(), start.data(),
                     column.data(), value.data());
}

}  // namespace delam::petsc
