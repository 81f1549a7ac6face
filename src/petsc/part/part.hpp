// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "petsc/base/communicator.hpp"
#include "petsc/base/local_matrix.hpp"

namespace delam::petsc {

// The part of the bodies' stiffness that this rank adds: over the DOFs of its nodes, dimension*i + component.
struct Part {
    std::int32_t dimension = 0;
    std::vector<std::int64_t> nodes;  // in the numbers of the mesh, or beyond; each once
    std::size_t ghosts = 0;           // of the nodes, the last ones: other ranks' rows are theirs (rows.hpp)
    bool of_rows = false;             // made of rows: only the sum over the ranks is positive semidefinite
    std::vector<double> coordinates;  // [nodes that are no ghosts][dimension], or empty
    LocalMatrix stiffness;

    std::span<const std::int64_t> own() const { return std::span(nodes).first(nodes.size() - ghosts); }
};

// Checks and copies the arrays of delam_petsc_set_part.
Part make_part(std::int32_t dimension, std::int64_t node_count, const std::int64_t* nodes, const double* coordinates,
               const std::int64_t* row_starts, const std::int64_t* columns, const double* values);
// The checks of arrays of all functions that hand over a stiffness: a part without one yet; row starts, which arrays
// there are, values.
Part make_nodes(std::int32_t dimension, std::int64_t node_count, const std::int64_t* nodes, const double* coordinates);
void check_rows(std::int64_t rows, const std::int64_t* row_starts, const std::int64_t* columns, const double* values);
void require_same_dimension(const Communicator& comm, std::int32_t dimension);  // collective

}  // namespace delam::petsc
