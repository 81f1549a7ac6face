// SPDX-License-Identifier: BSD-3-Clause
// The analysis: committed states, possibly a pending one, and the stepper that computes them.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/monitor.hpp"
#include "evolution/observe/observer.hpp"
#include "evolution/observe/record.hpp"
#include "evolution/observe/warnings.hpp"
#include "evolution/step/backtrack.hpp"
#include "evolution/step/jump_event.hpp"
#include "evolution/step/stepper.hpp"
#include "scene/problem.hpp"

namespace delam {

// Status with which a step ended; text is empty for DELAM_OK.
struct Outcome {
    std::int32_t status = 0;
    std::string text;
};

class Solver {
public:
    // The monitor must outlive the solver.
    Solver(const Problem& problem, Monitor& monitor, double time);
    Solver(const Solver&) = delete;  // the stepper points into problem_
    Solver& operator=(const Solver&) = delete;

    Outcome advance(double time);
    Outcome equilibrate(double time, std::span<const double> adhesion);
    void commit();
    void rollback();
    bool pending() const { return pending_.has_value(); }
    // Changes the history of a pattern from the committed time on.
    void set_history(std::int64_t pattern, std::span<const double> times, std::span<const double> values);
    // Patterns whose history was changed, with their present histories.
    std::vector<std::int64_t> changed_histories() const;
    // Makes commit() record this value for every step, beginning with the committed state.
    void record(const std::string& key);
    const Record& recorded() const { return record_; }
    // Hash of the scene at the solver's creation.
    std::uint64_t scene_hash() const { return scene_hash_; }
    // Makes state() that of an earlier kept step, of the pending chain or the committed one; -1: the present one.
    void select(std::int64_t step);
    // The first step that can be read and returned to.
    std::int64_t first_kept() const { return past_.empty() ? committed_.step : past_.front().step; }

    const Problem& problem() const { return problem_; }
    // Outcome of the displacement step of the initial state.
    const Outcome& initial_outcome() const { return initial_outcome_; }
    // The state being read if select() selected one, otherwise the pending or the committed one.
    const State& state() const { return selected_ != nullptr ? *selected_ : pending_ ? pending_->state : committed_; }
    const State& committed() const { return committed_; }
    // Kept steps before the committed one, oldest first.
    const std::vector<State>& past() const { return past_; }
    // Jumps of the analysis up to the committed state, and with `pending` those of the pending step.
    std::vector<JumpEvent> jumps(bool pending) const;
    // Replaces the committed states (of the same scene); discards a pending one.
    void restore(State state, std::vector<State> past, std::vector<JumpEvent> jumps, std::vector<Pattern> patterns,
                 Record record);
    // The scene at the solver's creation.
    const std::vector<Pattern>& first_patterns() const { return first_patterns_; }
    bool keeps_past() const { return delam::keeps_past(problem_.options); }
    // Reads state().
    Observer& observer() { return observer_; }
    const Observer& observer() const { return observer_; }
    // Values of a state (values.hpp); warns once if cells rotate much.
    std::vector<double> values(const State& state, const std::vector<std::string>& keys);
    // d2E / dtheta2 at fixed adhesion and contact set of state(), [patterns][patterns].
    std::vector<double> tangent() { return stepper_.tangent(state()); }
    // Consistent tangent of the pending step, [patterns][patterns].
    std::vector<double> step_tangent();
    // From the initial state on, follows the derivatives by a number of the laws of these interfaces; its index.
    std::int64_t follow(std::span<const std::int64_t> interfaces, const std::string& key);
    // Returns dE/dtheta of state() by the parameters that are followed, [patterns][parameters].
    std::vector<double> sensitivities() const;
    std::int64_t followed() const { return static_cast<std::int64_t>(followed_.size()); }
    const JumpOperator& jump_operator() const { return stepper_.op(); }
    // The bodies condensed onto the jumps; null: they are not.
    const Bulk* condensed() const { return stepper_.design().condensed; }
    const ReductionChoice& reduction() const { return stepper_.reduction(); }
    // A text about the search of the pending step, or of the committed one if none is pending; empty: no search.
    const std::string& searched() const { return pending_ ? pending_->searched : searched_; }

private:
    struct Pending {
        State state;
        std::vector<State> revised;  // earlier steps that backtracking has replaced, ascending
        std::vector<JumpEvent> jumps;
        std::string searched;
    };

    Outcome follow(double time);
    void require_nothing_pending(double time) const;
    Outcome unconverged_displacement(const State& state) const;
    // Appends what happened in a step that jumps.
    void note_jump(const State& before, State& after, std::vector<JumpEvent>& jumps) const;
    void judge_balance(const State& state, Outcome& outcome);

    Problem problem_;
    std::vector<FollowedParameter> followed_;
    std::vector<Pattern> first_patterns_;  // before any history was changed
    std::uint64_t scene_hash_;
    Monitor& monitor_;
    Stepper stepper_;
    PairGraph graph_;
    Outcome initial_outcome_;
    State committed_;
    std::string searched_;  // of the step to committed_; empty where that was loaded, since it is not saved
    std::vector<State> past_;
    std::vector<JumpEvent> jumps_;
    Record record_;
    std::optional<Pending> pending_;
    const State* selected_ = nullptr;
    bool warned_of_mixity_ = false;
    Observer observer_;
    Warnings warnings_;
};

// Returns a value of the state that the solver shows (values.hpp).
inline double value(Solver& solver, const std::string& key) { return solver.values(solver.state(), {key}).front(); }

}  // namespace delam
