// SPDX-License-Identifier: BSD-3-Clause
// What acts on the jump rows, as entries of a matrix of all variables, for preconditioners. There a held row is a
// spring so stiff that the bodies do not feel it give way: the pattern of the matrix then does not depend on contact.
#pragma once

#include <span>
#include <vector>

#include "linalg/sparse.hpp"
#include "reduction/iterated/jump_system.hpp"

namespace delam {

// Of the bodies' stiffness: a held row.
inline constexpr double held_as = 1e8;

// Of the diagonal, on variables of constraints on many: parts that only such constraints hold would leave a factor
// singular. Far below what the bodies feel.
inline constexpr double constraint_shift = 1e-7;

// Stiffness of the bodies against a row: the largest of its variables.
double row_diagonal(const JumpSystem& system, std::size_t row);
// N^T C N, held rows included.
std::vector<Triplet> spring_entries(const JumpSystem& system, std::span<const Zone::Coupling> couplings,
                                    std::span<const std::uint8_t> held);

}  // namespace delam
