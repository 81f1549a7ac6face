// SPDX-License-Identifier: BSD-3-Clause
// The small dense system that is left when everything that does not change has been condensed: unknowns x of an energy,
// rows j = N x + O theta with springs (or, for Newton's method, coupled 2x2 or 3x3 tangents) and rows that are held at
// zero.
//
//   minimise  1/2 x^T S x - theta^T L^T x + 1/2 sum_rq j_r C_rq j_q - sum_r h_r j_r      subject to j_r = 0 on held
//   rows
//
// Rigid motions Z that nothing outside resists (S Z = 0) have unknowns alpha of their own, x = Z alpha + y, with S +
// rho Z Z^T for y: however weak the springs that hold them are, nothing cancels. The active rows, not pivots, determine
// which motions are held at all.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "reduction/zone/dense_energy.hpp"
#include "reduction/zone/jump_row.hpp"
#include "reduction/zone/rigid_jumps.hpp"

namespace delam {

class Zone {
public:
    // rows: in unknowns of the zone; jump_rows: the operator's jump row of each of them, ascending. rigid:
    // [unknowns][motions], orthonormal. poll: called within factor(). `energy` must outlive the zone.
    Zone(const DenseEnergy& energy, std::vector<JumpRow> rows, std::vector<std::int64_t> jump_rows, DenseMatrix rigid,
         Poll poll = {});

    struct Coupling {
        std::int64_t row, column;  // of the zone; both (r, q) and (q, r) are given
        double value;
    };
    // False: not positive definite.
    bool factor(std::span<const Coupling> couplings, std::span<const std::uint8_t> held);

    struct Solution {
        std::vector<double> unknowns;
        std::vector<double>
            multiplier;        // [rows] force of held rows that are not an unknown of their own; zero elsewhere
        bool balanced = true;  // false: a free motion carries a load; the rest is then not set
    };
    // row_force: h, [rows] or empty.
    Solution solve(std::span<const double> theta, std::span<const double> row_force) const;

    const std::vector<JumpRow>& rows() const { return rows_; }
    const std::vector<std::int64_t>& jump_rows() const { return jump_rows_; }
    const DenseEnergy& energy() const { return *energy_; }
    // j of all rows.
    std::vector<double> jumps(std::span<const double> theta, std::span<const double> unknowns) const;
    // Forces on all rows: those of rows that are not held are given, and this adds those of held rows.
    void complete_forces(std::span<const double> theta, const Solution& solution, std::span<double> row_force) const;
    // 1/2 x^T S x - theta^T L^T x
    double energy_of(std::span<const double> theta, std::span<const double> unknowns) const;

private:
    void hold(std::span<const std::uint8_t> held);
    void assemble();
    bool factor_motions();
    bool balances(std::span<const double> load) const;
    // y = (S + C) x over all unknowns
    std::vector<double> apply(std::span<const double> x) const;
    std::vector<double> expand(std::span<const double> reduced) const;
    std::vector<double> reduce(std::span<const double> full) const;
    std::vector<double> offsets(std::span<const double> theta) const;

    const DenseEnergy* energy_;
    std::vector<JumpRow> rows_;
    std::vector<std::int64_t> jump_rows_;
    std::vector<std::int64_t> plain_;
    bool with_offsets_ = false;
    DenseMatrix rigid_;       // Z
    DenseMatrix rigid_rows_;  // N Z
    DenseMatrix shifted_;     // S + rho Z Z^T where Z is not empty

    Poll poll_;
    // Of the last factor():
    std::vector<std::uint8_t> held_;
    std::vector<Triplet> springs_;  // C in unknowns, sum N^T C N
    std::vector<Coupling> couplings_;
    std::vector<std::int64_t> free_;        // unknowns that are solved for
    std::vector<std::int64_t> bound_rows_;  // held rows that bind several unknowns or have an offset
    std::vector<std::int64_t> bound_;       // unknowns that these fix
    DenseMatrix binding_;                   // M: bound = M free (+ offsets)
    DenseMatrix operations_;                // echelon: [bound][bound_rows]
    DenseMatrix factor_;
    Combinations motions_;
    DenseMatrix motion_y_, motion_x_;  // Y (what y must do), X = Z + Y
    DenseMatrix motion_coupling_;      // H_r,alpha
    DenseMatrix motion_solved_;        // H_rr^-1 H_r,alpha
    DenseMatrix motion_factor_;        // of the Schur complement in held motions, scaled
    std::vector<double> motion_scale_;
};

}  // namespace delam
