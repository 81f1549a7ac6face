// SPDX-License-Identifier: BSD-3-Clause
// A zone without a matrix of its own: the whole skeleton is factored along its tree (tree_factor.hpp), with the springs
// of the zone among those of all other jumps. Where many interfaces soften at once, a dense zone rides through all cuts
// of the tree, and its factor costs more than the tree itself.
//
// Its `unknowns` are, of all rows of the zone, the jumps d, the forces g = S d - L theta with which the bodies resist
// them (all else minimised out), and a number w such that the energy is (d.g - w) / 2. All of these are affine in d.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "reduction/condensed/bulk.hpp"
#include "reduction/condensed/tree_factor.hpp"
#include "reduction/condensed/zone_choice.hpp"
#include "reduction/operator/jump_row.hpp"
#include "reduction/operator/response.hpp"
#include "reduction/operator/zone.hpp"

namespace delam {

// A solve of the operator whose forces and jumps are known.
struct SolvedState {
    std::vector<double> theta, springs, jump;  // springs: of the unknowns, -1: held; empty: none
};

class TreeZone final : public Zone {
public:
    // True if such zones exist for these bodies: every jump row is an unknown of its own or prescribed, the rows of a
    // pair belong to one node of the tree, and equations determine no more than kept displacements.
    static bool offered_by(const Bulk& bulk, const TreeFactor& factor, std::int64_t dimension);

    // jump_rows: of the zone, ascending. All but poll must outlive the zone.
    TreeZone(const Bulk& bulk, TreeFactor& factor, const ZoneChoice& choice, std::vector<std::int64_t> jump_rows,
             const SolvedState& solved, Poll poll);

    bool factor(std::span<const Coupling> couplings, std::span<const std::uint8_t> held) override;
    Solution solve(std::span<const double> theta, std::span<const double> row_force) override;
    bool offers_flexibility() const override { return true; }
    std::optional<DenseMatrix> flexibility(std::span<const std::vector<RowForce>> forces) override;
    const std::vector<std::int64_t>& jump_rows() const override { return jump_rows_; }
    std::vector<double> unknowns_at(std::span<const double> theta, const Response& response) override;
    void keep(std::span<const double>, Response&) const override {}
    std::vector<double> jumps(std::span<const double> theta, std::span<const double> unknowns) const override;
    void complete_forces(std::span<const double> theta, const Solution& solution,
                         std::span<double> row_force) const override;
    double energy_of(std::span<const double> theta, std::span<const double> unknowns) override;
    double energy_rounding() const override { return 1e-14; }

    // Solves for the whole skeleton, with everything outside the zone.
    std::vector<double> skeleton(std::span<const double> theta, std::span<const double> row_force);

private:
    double offset(std::size_t row, std::span<const double> theta) const;
    std::vector<double> right_side(std::span<const double> theta) const;
    std::vector<double> apply(std::span<const double> theta, std::span<const double> row_force);
    void resist(std::span<const double> theta, std::span<const std::size_t> rows, std::span<double> force) const;

    const Bulk& bulk_;
    TreeFactor& tree_;
    const ZoneChoice& choice_;
    std::vector<std::int64_t> jump_rows_;
    const SolvedState& solved_;
    Poll poll_;
    std::vector<std::int64_t> place_;         // [rows] of the skeleton; -1: prescribed
    std::vector<std::uint8_t> nodes_;         // with rows of the zone
    std::vector<std::uint8_t> outside_held_;  // [places] of all but the zone
    std::vector<double> outside_spring_;
    // State of the last factor() and solve():
    std::vector<std::uint8_t> held_;  // [rows]
    std::vector<Coupling> couplings_;
    std::vector<double> load_, x_;  // [places]
};

}  // namespace delam
