// SPDX-License-Identifier: BSD-3-Clause
// A body solver that leaves the bodies to an engine of the host (scene/engine.hpp). It knows the trailing variables
// alone: jumps, and displacements in long constraints. What it knows of the others it knows from the engine's answers.
//
// Of what a state consists is in engine_state.hpp. The energy follows from the products u_s^T K u_t of kept answers, to
// second order in what the solves have left. A saved state of another time is solved for once more, with all its
// variables given.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "reduction/operator/body_system.hpp"
#include "reduction/sparse/body_solver.hpp"
#include "reduction/sparse/engine/engine_calls.hpp"
#include "reduction/sparse/engine/engine_state.hpp"
#include "reduction/sparse/engine/kept_answers.hpp"
#include "reduction/sparse/floating.hpp"
#include "reduction/sparse/renewal.hpp"
#include "scene/engine.hpp"

namespace delam {

class EngineSolver final : public BodySolver {
public:
    // bodies: without a stiffness.
    EngineSolver(const BodySystem& bodies, std::shared_ptr<Engine> engine, Monitor& monitor);

    const JumpSystem& system() const override { return system_; }
    std::int64_t state_size() const override { return static_cast<std::int64_t>(at_.size()); }
    void compare_energies(bool yes) override { comparing_ = yes; }
    bool set(std::vector<Zone::Coupling> couplings, std::span<const std::uint8_t> held) override;
    Answer solve(std::span<const double> theta, std::span<const double> row_force, double tolerance,
                 std::vector<double>& x, const Forcing& forcing = {}) override;
    std::vector<double> held_forces(std::span<const double> theta, std::span<const double> x,
                                    std::span<double> force) const override;
    double load_size(std::span<const double> theta) const override;
    Work work(std::span<const double> theta, std::span<const double> x) override;
    double energy_rounding(std::span<const double>, std::span<const double>) override { return rounding_; }
    void recover(std::span<const double> theta, std::span<const double> x, std::vector<double>& displacement,
                 std::vector<double>& stressed) override;
    // The same, but the engine keeps them.
    void recover_in_engine(std::span<const double> theta, std::span<const double> x);
    void move(std::span<const double> displacement, std::span<const double> combination,
              std::span<double> x) const override;
    const Floating& floating() const override { return floating_; }
    std::int64_t factorisations() const override { return renewals_; }
    std::vector<double> memory() override;
    void recall(std::span<const double> memory) override;
    void require_memory(std::span<const double> memory) const override;

private:
    void claim();  // the engine has the variables of this operator
    void apply();  // the couplings and held rows
    void renew_now();
    void renew();  // at lagged_
    // True if tangents that soften leave a minimum.
    bool has_minimum();
    std::vector<double> forces(std::span<const double> theta, std::span<const double> row_force) const;
    std::vector<double> rights(std::span<const double> theta) const;
    // Fills x, but for the rigid motions.
    EngineCalls::Answer ask(std::span<const double> theta, std::span<const double> force, std::span<const double> right,
                            std::span<const double> start, double tolerance, std::int64_t limit, const Forcing& forcing,
                            std::vector<double>& x, bool reading = false);
    SolveError error_of(const EngineCalls::Answer& raw) const;
    // The weights of a state, as long as the answers that they name are kept. theta: of the state; empty: any.
    std::optional<std::vector<double>> known_weights(std::span<const double> x, std::span<const double> theta) const;
    std::vector<double> weights_of(std::span<const double> theta, std::span<const double> x);
    // Solves for the state whose variables are those of x, without its rigid motions or with them; its weights.
    std::vector<double> solve_again(std::span<const double> theta, std::span<const double> x, bool with_rigid = false);
    void settle(std::vector<double>& x) const;
    void count_motion(std::span<const double> displacement, std::span<const double> combination,
                      std::span<double> x) const;

    const BodySystem& bodies_;
    Monitor& monitor_;
    EngineCalls calls_;
    JumpSystem system_;
    Floating floating_;
    EngineLayout at_;
    KeptAnswers kept_;
    std::vector<double> load_sizes_;  // [patterns]
    std::vector<double> lift_force_;  // [patterns][patterns] U_p^T f_k

    std::vector<double> lagged_;  // [rows] springs of the preconditioner; empty: there is none
    bool comparing_ = false;      // energies
    bool applied_ = false;        // the engine has what acts
    bool renewed_ = false;        // the engine's preconditioner is that of lagged_
    double cost_ = 1.0;           // of a new one, in iterations
    Renewal renewal_;             // its price and excess in iterations
    double rounding_ = 1e-14;     // of energies
    std::int64_t renewals_ = 0;
};

}  // namespace delam
