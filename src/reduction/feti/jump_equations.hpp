// SPDX-License-Identifier: BSD-3-Clause
// Equations among the jumps of total FETI. Where interfaces meet, or supports act on both of their faces, a combination
// z of the rows of B vanishes, B^T z = 0, so that sum of z_r (B u)_r = 0: the jumps of such rows are no free unknowns.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "reduction/feti/dual/dual_loads.hpp"
#include "reduction/feti/dual/dual_operator.hpp"
#include "reduction/operator/jump_row.hpp"

namespace delam {

class JumpEquations {
public:
    JumpEquations(const DualOperator& dual, const DualLoads& loads, std::size_t patterns)
        : dual_(dual), loads_(loads), patterns_(patterns) {}

    // A row whose jump others determine: j_row = sum of n_k j_k + o(theta) over jump rows k.
    struct Dependent {
        std::int64_t row;
        JumpRow jump;
    };
    // Returns those of the rows that the rest of them determines, ascending; the rest is independent. free: true for
    // rows that may jump, neither bonded nor prescribed.
    std::vector<Dependent> among(std::span<const std::int64_t> rows,
                                 const std::function<bool(std::size_t)>& free) const;
    // The jump that constraints and gaps prescribe on a row, [patterns].
    std::vector<double> prescribed(std::size_t row) const;

private:
    // B u of a row that constraints prescribe, and the gap that the jump has beside it, [patterns].
    std::vector<double> moved(std::size_t row) const;
    std::vector<double> gap(std::size_t row) const;

    const DualOperator& dual_;
    const DualLoads& loads_;
    std::size_t patterns_;
};

}  // namespace delam
