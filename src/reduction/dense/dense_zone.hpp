// SPDX-License-Identifier: BSD-3-Clause
// A zone that is small and dense: everything that does not change has been condensed.
//
// Rigid motions Z that nothing outside resists (S Z = 0) have unknowns alpha of their own, x = Z alpha + y, with S +
// rho Z Z^T for y: however weak the springs that hold them are, nothing cancels. The active rows, not pivots, determine
// which motions are held at all.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "reduction/dense/dense_energy.hpp"
#include "reduction/dense/rigid_jumps.hpp"
#include "reduction/dense/updated_factor.hpp"
#include "reduction/operator/jump_row.hpp"
#include "reduction/operator/zone.hpp"

namespace delam {

// Rigid motions that nothing outside a zone resists.
struct ZoneMotions {
    DenseMatrix unknowns;         // Z, [unknowns][motions], orthonormal
    DenseMatrix combination;      // of the motions of the whole, [motions of the whole][motions]
    const DeadWork* dead_work{};  // along the motions of the whole; must outlive the zone

    // rigid: the motions of the whole, [rows][motions of the whole]; active: rows that resist them outside the zone;
    // row_of: the row of each unknown of the zone.
    static ZoneMotions of(const DenseMatrix& rigid, const DeadWork& dead_work, std::span<const std::uint8_t> active,
                          std::span<const std::int64_t> row_of);
};

class DenseZone final : public Zone {
public:
    // rows: in unknowns of the zone; jump_rows: the operator's jump row of each of them, ascending. poll: called
    // within factor(). `energy` must outlive the zone.
    DenseZone(const DenseEnergy& energy, std::vector<JumpRow> rows, std::vector<std::int64_t> jump_rows,
              ZoneMotions motions, Poll poll = {});

    // An energy at its minimum needs half of the digits of its solution.
    void ask_for_energies(double allowed) override { refine_ = !(allowed > 0.0); }
    void begin_model() override { refine_ = true; }
    bool factor(std::span<const Coupling> couplings, std::span<const std::uint8_t> held) override;
    Solution solve(std::span<const double> theta, std::span<const double> row_force) override;
    bool offers_flexibility() const override { return true; }
    std::optional<DenseMatrix> flexibility(std::span<const std::vector<RowForce>> forces) override;
    const std::vector<std::int64_t>& jump_rows() const override { return jump_rows_; }
    // The unknowns that are a jump row of their own start there, the others at zero.
    std::vector<double> unknowns_at(std::span<const double> theta, const Response& response) override;
    void keep(std::span<const double>, Response&) const override {}
    std::vector<double> jumps(std::span<const double> theta, std::span<const double> unknowns) const override;
    void complete_forces(std::span<const double> theta, const Solution& solution,
                         std::span<double> row_force) const override;
    double energy_of(std::span<const double> theta, std::span<const double> unknowns) override;
    double energy_of_moving(std::span<const std::size_t> rows, std::span<const double> d) const override;
    double energy_rounding() const override { return 1e-14; }
    const DenseMatrix* motions() const override { return &rigid_rows_; }
    void move(std::span<const double> combination, std::span<double> unknowns) const override {
        for (std::size_t c = 0; c < combination.size(); ++c)
            add_scaled(combination[c],
                       std::span<const double>(rigid_.value).subspan(c * unknowns.size(), unknowns.size()), unknowns);
    }

    const DenseEnergy& energy() const { return *energy_; }
    // Discards the results of earlier solves, on which the last digits of the next one depend.
    void forget() {
        updated_.forget();
        refine_ = true;
    }
    // Full factorisations so far.
    std::int64_t factorisations() const { return updated_.renewals() + bound_factors_; }

private:
    void hold(std::span<const std::uint8_t> held);
    const DenseMatrix& matrix() const { return rigid_.columns > 0 ? shifted_ : energy_->stiffness; }
    void assemble(const BoundUnknowns& unknowns);
    bool factor_free();
    // again: the next solve may be of the same load.
    void solve_free(std::span<double> x, bool again);
    void solve_together(std::vector<double>& y, std::vector<double>& alpha, bool again);
    bool factor_motions();
    bool balances(std::span<const double> theta, std::span<const double> row_force) const;
    // y = (S + C) x over all unknowns
    std::vector<double> apply(std::span<const double> x) const;
    std::vector<double> expand(std::span<const double> reduced) const;
    std::vector<double> reduce(std::span<const double> full) const;
    std::vector<double> offsets(std::span<const double> theta) const;

    const DenseEnergy* energy_;
    std::vector<JumpRow> rows_;
    std::vector<std::int64_t> jump_rows_;
    std::vector<std::int64_t> plain_;    // [rows] unknown that the row is, -1: none
    std::vector<std::int64_t> rows_of_;  // [unknowns] number of rows in which it appears
    bool with_offsets_ = false;
    DenseMatrix rigid_;  // Z
    DenseMatrix combination_;
    const DeadWork* dead_work_;
    DenseMatrix rigid_rows_;  // N Z
    DenseMatrix shifted_;     // S + rho Z Z^T where Z is not empty

    Poll poll_;
    bool refine_ = true;  // solutions of updated factors
    // State of the last factor():
    std::vector<std::uint8_t> held_;
    std::vector<Triplet> springs_;  // C in unknowns, sum N^T C N
    std::vector<Coupling> couplings_;
    std::vector<std::int64_t> free_;        // unknowns that are solved for
    std::vector<std::int64_t> bound_rows_;  // held rows that bind several unknowns or have an offset
    std::vector<std::int64_t> bound_;       // unknowns that these fix
    DenseMatrix binding_;                   // M: bound = M free (+ offsets)
    DenseMatrix operations_;                // echelon: [bound][bound_rows]
    UpdatedFactor updated_;
    bool by_updates_ = true;  // false: the matrix of the free unknowns has a factor of its own
    DenseMatrix factor_;      // that one; else memory for the next matrix
    std::int64_t bound_factors_ = 0;
    Combinations motions_;
    DenseMatrix motion_y_, motion_x_;  // Y (what y must do), X = Z + Y
    DenseMatrix motion_stiffness_;     // H_alpha,alpha
    DenseMatrix motion_coupling_;      // H_r,alpha
    DenseMatrix motion_solved_;        // H_rr^-1 H_r,alpha
    DenseMatrix motion_factor_;        // of the Schur complement in held motions, scaled
    std::vector<double> motion_scale_;
};

}  // namespace delam
