// SPDX-License-Identifier: BSD-3-Clause
// The bodies about some rows as a zone, with all else where a state has it. Its unknowns d are changes of their
// variables from that state, v = v0 + P d:
//
//   minimise  1/2 d^T A d - r^T d + what acts on the rows j = j0 + N d,
//
// where A = P^T T^T K T P and r = P^T (g - T^T K T v0).
//
// A minimiser that goes down here goes down for the whole (nonlinear relocalisation, Ph. Cresta, O. Allix, C. Rey,
// S. Guinard, CMAME 196, 2007), for a factorisation of a small part.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "linalg/sparse/cholesky.hpp"
#include "reduction/operator/zone.hpp"
#include "reduction/sparse/jump_system.hpp"
#include "scene/limits.hpp"

namespace delam {

class LocalZone final : public Zone {
public:
    // dimension: rows of a pair.
    LocalZone(const JumpSystem& system, std::int64_t dimension);

    // The bodies about the wanted rows [rows] at this state, under the loads g and theta. False: they are no small
    // part.
    bool enter(std::span<const std::uint8_t> wanted, std::span<const double> theta, std::span<const double> load,
               std::span<const double> state, const Poll& poll);

    bool factor(std::span<const Coupling> couplings, std::span<const std::uint8_t> held) override;
    Solution solve(std::span<const double> theta, std::span<const double> row_force) override;
    const std::vector<std::int64_t>& jump_rows() const override { return jump_rows_; }
    // That of the state with which the zone was entered.
    std::vector<double> unknowns_at(std::span<const double> theta, const Response& response) override;
    void keep(std::span<const double> unknowns, Response& response) const override;
    std::vector<double> jumps(std::span<const double> theta, std::span<const double> unknowns) const override;
    void complete_forces(std::span<const double> theta, const Solution& solution,
                         std::span<double> row_force) const override;
    double energy_of(std::span<const double> theta, std::span<const double> unknowns) override;
    double energy_rounding() const override { return 1e-13; }

private:
    // Whole pairs of the marked variables; unmarks variables of pairs that are not whole.
    void take_pairs(std::vector<std::uint8_t>& member);
    void add_row(std::size_t z, double factor, std::span<double> force) const;
    double change(std::size_t z, std::span<const double> unknowns) const;  // N d

    const JumpSystem& system_;
    std::size_t dim_;
    std::vector<std::uint8_t> barred_;     // [variables] of constraints on many variables
    std::vector<std::int64_t> variables_;  // ascending
    std::vector<std::int64_t> jump_rows_;
    std::vector<SparseVector> rows_;  // N, in the zone's own variables
    SparseMatrix matrix_;
    std::unique_ptr<SparseCholesky> factor_;
    double largest_ = 0.0;       // variable of the state
    std::vector<double> state_;  // v0, [unknowns]
    std::vector<double> jump_;   // j0, [rows]
    std::vector<double> left_;   // r
    std::vector<Coupling> couplings_;
    std::vector<double> held_as_;  // [rows] stiffness of the spring that holds a row, 0: it is free
};

}  // namespace delam
