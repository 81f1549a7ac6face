// SPDX-License-Identifier: BSD-3-Clause
// All bodies as the zone: its rows are all jump rows, its unknowns all variables. What is indefinite shows where the
// tangents are, in the factor of a patch, or in the curvature along a direction of the iteration.
#pragma once

#include "reduction/operator/zone.hpp"
#include "reduction/sparse/body_solver.hpp"
#include "scene/options.hpp"

namespace delam {

class IteratedZone final : public Zone {
public:
    IteratedZone(BodySolver& solver, const Options& options);

    void begin_model() override;
    void ask_for_energies(double allowed) override;
    bool factor(std::span<const Coupling> couplings, std::span<const std::uint8_t> held) override;
    Solution solve(std::span<const double> theta, std::span<const double> row_force) override;
    const std::vector<std::int64_t>& jump_rows() const override { return jump_rows_; }
    std::vector<double> unknowns_at(std::span<const double> theta, const Response& response) override;
    void keep(std::span<const double> unknowns, Response& response) const override;
    std::vector<double> jumps(std::span<const double> theta, std::span<const double> unknowns) const override;
    void complete_forces(std::span<const double> theta, const Solution& solution,
                         std::span<double> row_force) const override;
    // The energy of the bodies, from their displacements.
    double energy_of(std::span<const double> theta, std::span<const double> unknowns) override;
    double energy_rounding() const override;
    const DenseMatrix* motions() const override { return &solver_.floating().jumps(); }
    void move(std::span<const double> combination, std::span<double> unknowns) const override;
    // The next solve does not depend on those before.
    void start_anew();
    // No model has come before the next one.
    void forget_models();

private:
    BodySolver& solver_;
    Limits limits_;
    double tolerance_;  // of the relative residual
    // Norms of residuals, of the present model and the one before: with which it began, and what its last solve left.
    struct Model {
        double begun = 0.0;  // negative: not solved yet; 0: there is no model
        double left = 0.0;
    };
    Model model_, before_;
    double part_ = 0.0;     // of the residual with which the model begins: what a solve may leave
    double allowed_ = 0.0;  // above the least energy, F L; 0: only the tolerance counts
    std::vector<std::int64_t> jump_rows_;
    std::vector<double> start_;  // of the next solve
    double rounding_ = -1.0;     // of energy_of(), relative; negative: not yet known
};

}  // namespace delam
