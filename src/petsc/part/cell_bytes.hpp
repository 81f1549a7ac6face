// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "delam/delam.h"
#include "petsc/part/part.hpp"

namespace delam::petsc {

// Returns, as bytes, what determines the stiffness of a problem's cells; none for no cells. rank: whose problem it is,
// for messages.
std::vector<std::uint8_t> part_bytes(const delam_problem* problem, const std::vector<std::int64_t>& cells, int rank);
// Their stiffness, over the numbers of the problem's mesh. dimension: of a part without cells.
Part part_of_bytes(std::int32_t dimension, const std::vector<std::uint8_t>& bytes);
// Refuses a body without cells: its stiffness is the host's, which no part carries.
void require_cells(const delam_mesh* mesh);

}  // namespace delam::petsc
