// SPDX-License-Identifier: BSD-3-Clause
// The energy of all bodies condensed onto the jumps, for hosts:
//   E(theta, x) = 1/2 x^T S x - theta^T L^T x + 1/2 theta^T A theta,      jump rows  j = N x + O theta.
#pragma once

#include <cstdint>

#include "evolution/analysis/solver.hpp"

namespace delam {

struct CondensedSize {
    std::int64_t unknowns;  // of x
    std::int64_t entries;   // of N
};

// Both throw Error(DELAM_ERROR_STATE) if the operator is not condensed.
CondensedSize condensed_size(const Solver& solver);

// Null: not requested.
struct CondensedMatrices {
    double* stiffness = nullptr;         // S, [unknowns][unknowns]
    double* load = nullptr;              // L, [patterns][unknowns]
    double* constant = nullptr;          // A, [patterns][patterns]
    std::int64_t* row_starts = nullptr;  // N by rows: [rows + 1], columns and values [entries]
    std::int64_t* columns = nullptr;
    double* values = nullptr;
    double* offset = nullptr;  // O, [rows][patterns]
};
void copy_condensed(const Solver& solver, const CondensedMatrices& out);

}  // namespace delam
