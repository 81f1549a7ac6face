// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/part/part.hpp"

#include <algorithm>
#include <cmath>

#include "base/numbers.hpp"
#include "petsc/base/failure.hpp"

namespace delam::petsc {

namespace {

void check_nodes(const std::vector<std::int64_t>& nodes) {
    std::vector<std::int64_t> sorted(nodes);
    std::sort(sorted.begin(), sorted.end());
    if (!sorted.empty() && sorted.front() < 0) fail(DELAM_ERROR_ARGUMENT, "nodes: ", sorted.front(), " is negative");
    // DOFs are dimension*node + component: far beyond any memory, and three times it fits 64 bits.
    constexpr std::int64_t largest = std::int64_t{1} << 48;
    if (!sorted.empty() && sorted.back() > largest)
        fail(DELAM_ERROR_ARGUMENT, "nodes: ", sorted.back(), " is outside 0 .. ", largest);
    const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
    if (twice != sorted.end()) fail(DELAM_ERROR_ARGUMENT, "nodes: node ", *twice, " occurs twice");
}

LocalMatrix copy_rows(std::int64_t rows, const std::int64_t* row_starts, const std::int64_t* columns,
                      const double* values) {
    check_rows(rows, row_starts, columns, values);
    LocalMatrix matrix;
    matrix.rows = matrix.columns = petsc_int(rows);
    if (rows == 0) return matrix;
    const std::int64_t entries = row_starts[rows];
    matrix.start.assign(row_starts, row_starts + rows + 1);
    matrix.column.reserve(index(entries));
    for (std::int64_t e = 0; e < entries; ++e) {
        if (columns[e] < 0 || columns[e] >= rows)
            fail(DELAM_ERROR_ARGUMENT, "columns: ", columns[e], " of entry ", e, " is not in [0, ", rows, ")");
        matrix.column.push_back(static_cast<PetscInt>(columns[e]));
    }
    matrix.value.assign(values, values + entries);
    matrix.sort_rows();
    return matrix;
}

}  // namespace

void check_rows(std::int64_t rows, const std::int64_t* row_starts, const std::int64_t* columns, const double* values) {
    if (rows == 0) return;
    if (row_starts == nullptr) fail(DELAM_ERROR_ARGUMENT, "row_starts: NULL with ", rows, " rows");
    if (row_starts[0] != 0) fail(DELAM_ERROR_ARGUMENT, "row_starts[0] = ", row_starts[0], ": has to be 0");
    for (std::int64_t r = 0; r < rows; ++r)
        if (row_starts[r + 1] < row_starts[r])
            fail(DELAM_ERROR_ARGUMENT, "row_starts[", r + 1, "] = ", row_starts[r + 1], ": has to be at least ",
                 row_starts[r]);
    const std::int64_t entries = row_starts[rows];
    if (entries > static_cast<std::int64_t>(PETSC_MAX_INT))
        fail(DELAM_ERROR_ARGUMENT, "row_starts[", rows, "] = ", entries, ", allowed: 0 to ", PETSC_MAX_INT,
             " (entries, in PETSc's integers)");
    if (entries > 0 && (columns == nullptr || values == nullptr))
        fail(DELAM_ERROR_ARGUMENT, "columns or values: NULL with ", entries, " entries");
    for (std::int64_t e = 0; e < entries; ++e)
        if (!std::isfinite(values[e])) fail(DELAM_ERROR_ARGUMENT, "values: ", values[e], " of entry ", e);
}

Part make_nodes(std::int32_t dimension, std::int64_t node_count, const std::int64_t* nodes, const double* coordinates) {
    if (dimension != 2 && dimension != 3) fail(DELAM_ERROR_ARGUMENT, "dimension = ", dimension, ": has to be 2 or 3");
    if (node_count < 0) fail(DELAM_ERROR_ARGUMENT, "node_count = ", node_count, ": has to be at least 0");
    if (node_count > 0 && nodes == nullptr) fail(DELAM_ERROR_ARGUMENT, "nodes: NULL with ", node_count, " nodes");
    if (node_count > static_cast<std::int64_t>(PETSC_MAX_INT) / dimension)
        fail(DELAM_ERROR_ARGUMENT, "node_count = ", node_count, ", allowed: 0 to ",
             static_cast<std::int64_t>(PETSC_MAX_INT) / dimension, " (the DOFs have to fit into PETSc's integers)");
    Part part;
    part.dimension = dimension;
    part.nodes.assign(nodes, nodes + node_count);
    check_nodes(part.nodes);
    if (coordinates != nullptr) part.coordinates.assign(coordinates, coordinates + node_count * dimension);
    for (const double x : part.coordinates)
        if (!std::isfinite(x)) fail(DELAM_ERROR_ARGUMENT, "coordinates: ", x, " is not finite");
    return part;
}

Part make_part(std::int32_t dimension, std::int64_t node_count, const std::int64_t* nodes, const double* coordinates,
               const std::int64_t* row_starts, const std::int64_t* columns, const double* values) {
    Part part = make_nodes(dimension, node_count, nodes, coordinates);
    part.stiffness = copy_rows(node_count * dimension, row_starts, columns, values);
    return part;
}

void require_same_dimension(const Communicator& comm, std::int32_t dimension) {
    const std::int64_t largest = comm.largest(static_cast<std::int64_t>(dimension));
    comm.together([&] {
        if (dimension != largest)
            fail(DELAM_ERROR_ARGUMENT, "dimension = ", dimension, ", but another rank has ", largest);
    });
}

}  // namespace delam::petsc
