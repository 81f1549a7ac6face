// SPDX-License-Identifier: BSD-3-Clause
// The march: a committed state, perhaps a pending one, and the operator they live on.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/monitor.hpp"
#include "evolution/bounds.hpp"
#include "evolution/minimise.hpp"
#include "evolution/plan.hpp"
#include "reduction/choose.hpp"
#include "scene/problem.hpp"

namespace delam {

// How a step ended; text is empty for DELAM_OK.
struct Outcome {
    std::int32_t status = 0;
    std::string text;
};

class Solver {
public:
    // The monitor must outlive the solver.
    Solver(const Problem& problem, Monitor& monitor, double time);
    Solver(const Solver&) = delete;  // pairs_ points into problem_
    Solver& operator=(const Solver&) = delete;

    Outcome advance(double time);
    Outcome equilibrate(double time, std::span<const double> adhesion);
    void commit();
    void rollback();
    bool pending() const { return pending_.has_value(); }

    const Problem& problem() const { return problem_; }
    // How the displacements of the initial state ended.
    const Outcome& initial_outcome() const { return initial_outcome_; }
    // Pending state, else the committed one.
    const State& state() const { return pending_ ? *pending_ : committed_; }
    const State& committed() const { return committed_; }
    // Replaces the committed state (of the same scene); drops a pending one.
    void restore(State state);
    const PairLaws& pairs() const { return pairs_; }
    const ContactScene& contact() const { return contact_; }
    // Recovered on request, [mesh DOFs]; kept until the state changes.
    const std::vector<double>& displacement() const;
    // Forces of the device, [constraints].
    std::vector<double> reaction() const { return operator_->reaction(state().theta, state().response); }
    // How often displacements were recovered.
    std::int64_t recoveries() const { return operator_->recoveries(); }
    const JumpOperator& jump_operator() const { return *operator_; }
    const ReductionChoice& reduction() const { return reduction_; }
    // Out-of-balance force over the largest reaction.
    double equilibrium_defect() const;
    // What the scene needs and what was left out (plan.hpp).
    std::vector<PlanItem> plan() const;
    // Initial adhesion, [pairs].
    const std::vector<double>& initial_adhesion() const { return initial_adhesion_; }

private:
    Minimiser minimiser() const;
    Outcome unconverged_displacement(const State& state) const;
    void begin(State& next, double time) const;
    void book_energies(State& state) const;
    void book_step(State& next) const;

    Problem problem_;
    Monitor& monitor_;
    PairLaws pairs_;
    ContactScene contact_;
    std::vector<double> initial_adhesion_;
    std::unique_ptr<JumpOperator> operator_;
    ReductionChoice reduction_;
    Lift lift_;
    Outcome initial_outcome_;
    State committed_;
    std::optional<State> pending_;
    mutable std::vector<double> displacement_;  // of state(), empty: not recovered
};

}  // namespace delam
