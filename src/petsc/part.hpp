// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "petsc/local_matrix.hpp"

namespace delam::petsc {

// What this rank adds to the stiffness of the bodies: over the DOFs of its nodes, dimension*i + component.
struct Part {
    std::int32_t dimension = 0;
    std::vector<std::int64_t> nodes;  // in the numbers of the mesh, or beyond; each once
    std::vector<double> coordinates;  // [nodes][dimension], or empty
    LocalMatrix stiffness;
};

// Checks and copies the arrays of delam_petsc_set_part.
Part make_part(std::int32_t dimension, std::int64_t node_count, const std::int64_t* nodes, const double* coordinates,
               const std::int64_t* row_starts, const std::int64_t* columns, const double* values);

}  // namespace delam::petsc
