// SPDX-License-Identifier: BSD-3-Clause
// The springs on the jump rows, as entries of a matrix of all variables, for preconditioners. A held row is there a
// spring so stiff that its displacement does not affect the bodies: the pattern of the matrix then does not depend on
// contact.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "linalg/sparse/sparse.hpp"
#include "reduction/sparse/jump_system.hpp"

namespace delam {

// Stiffness of a held row, relative to that of the bodies.
inline constexpr double held_as = 1e8;

// Relative to the diagonal, on variables of constraints on many: parts that only such constraints hold would leave a
// factor singular. It is too small to affect the bodies.
inline constexpr double constraint_shift = 1e-7;

// Stiffness of the bodies against a row: the largest of its variables.
double row_diagonal(const JumpSystem& system, std::size_t row);
// N^T C N, held rows included.
std::vector<Triplet> spring_entries(const JumpSystem& system, std::span<const Zone::Coupling> couplings,
                                    std::span<const std::uint8_t> held);

// Returns the present springs on the rows, with those that stand for held rows: [rows].
std::vector<double> springs_of(const JumpSystem& system);

// A spring differs from an earlier one if bodies and spring together are stiffer or softer by a share of
// Limits::spring_differs; of spring_differs_in_kind where tangents soften or couple rows, which no preconditioner can
// have.
// [rows] 1: what acts on it differs from these springs [rows].
std::vector<std::uint8_t> differing_rows(const JumpSystem& system, std::span<const double> springs);
// True if the spring on some row is softer than these springs.
bool any_softer(const JumpSystem& system, std::span<const double> springs);

}  // namespace delam
