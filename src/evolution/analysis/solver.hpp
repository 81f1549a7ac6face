// SPDX-License-Identifier: BSD-3-Clause
// The analysis: its states, and the stepper that computes them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/monitor.hpp"
#include "evolution/analysis/states.hpp"
#include "evolution/observe/observer.hpp"
#include "evolution/observe/record.hpp"
#include "evolution/observe/warnings.hpp"
#include "evolution/step/stepper.hpp"
#include "scene/check/step_control.hpp"
#include "scene/problem.hpp"
#include "scene/stage.hpp"

namespace delam {

// A stage of an analysis whose supports begin or end.
struct StageOf {
    std::shared_ptr<const Problem> whole;  // the scene of the host
    Stage stage;
    double until;  // the change of supports at which it ends; infinite: none
};

// Status with which a step ended; text is empty for DELAM_OK.
struct Outcome {
    std::int32_t status = 0;
    std::string text;
    bool outgrown = false;  // kinematics = auto: small rotations leave out too much, which the log has told
};

class Solver {
public:
    // The monitor must outlive the solver. other: the new one shares its condensed bodies, if they are the same.
    Solver(const Problem& problem, Monitor& monitor, double time, const Solver* other = nullptr);
    // Goes on from where `before` has come to, under the supports of another stage. displacement: there, [mesh DOFs];
    // empty: a state of this stage is about to be loaded.
    Solver(StageOf stage, const Solver& before, std::span<const double> displacement);
    Solver(const Solver&) = delete;  // the stepper points into problem_
    Solver& operator=(const Solver&) = delete;

    Outcome advance(double time);
    Outcome equilibrate(double time, std::span<const double> adhesion);
    void commit();
    void rollback();
    // Changes the history of a pattern from the committed time on.
    void set_history(std::int64_t pattern, std::span<const double> times, std::span<const double> values);
    // Makes commit() record this value for every step, beginning with the committed state.
    void record(const std::string& key);
    const Record& recorded() const { return record_; }
    // Hash of the scene at the solver's creation.
    std::uint64_t scene_hash() const { return scene_hash_; }
    const States& states() const { return states_; }
    // The stage in which it is; null: the scene has no stages.
    const StageOf* stage() const { return stage_ ? &*stage_ : nullptr; }
    // Shows an earlier kept step (States::select).
    void select(std::int64_t step);

    const Problem& problem() const { return problem_; }
    // The step control that is used, and why.
    const StepControl& control() const { return control_; }
    // Outcome of the displacement step of the initial state.
    const Outcome& initial_outcome() const { return initial_outcome_; }
    // Replaces the committed states (of the same scene); discards a pending one.
    void restore(State state, std::vector<State> past, std::vector<JumpEvent> jumps, std::vector<Pattern> patterns,
                 Record record);
    // The scene at the solver's creation.
    const std::vector<Pattern>& first_patterns() const { return first_patterns_; }
    // Reads the state that is shown.
    Observer& observer() { return observer_; }
    const Observer& observer() const { return observer_; }
    // Values of a state (values.hpp); warns once if cells rotate much.
    std::vector<double> values(const State& state, const std::vector<std::string>& keys);
    // d2E / dtheta2 at fixed adhesion and contact set of the state that is shown, [patterns][patterns].
    std::vector<double> tangent() { return stepper_.tangent(states_.shown()); }
    // Consistent tangent of the pending step, [patterns][patterns].
    std::vector<double> step_tangent();
    // From now on, step_control = auto takes steps whole, for a host that iterates.
    void take_whole_steps();
    // From the initial state on, follows the derivatives by a number of the laws of these interfaces; its index.
    // Rotations then stay small, whatever kinematics = auto finds.
    std::int64_t follow(std::span<const std::int64_t> interfaces, const std::string& key);
    // Returns dE/dtheta of the state that is shown by the parameters that are followed, [patterns][parameters].
    std::vector<double> sensitivities() const;
    // The stepper, with the jump operator and how it was chosen.
    const Stepper& stepper() const { return stepper_; }

private:
    Solver(std::optional<StageOf> stage, const Problem& problem, std::uint64_t hash, Monitor& monitor,
           const Solver* other);
    // Computes the initial state.
    void begin(double time);
    void require_nothing_pending(double time) const;
    // The state must lie in this stage.
    void require_in_stage(double time) const;
    Outcome unconverged_displacement(const State& state) const;
    struct Chosen {
        StepControl control;
        Options options;
    };
    Chosen chosen(std::int64_t way, double dissipated, bool follows) const;
    void adopt(Chosen next) noexcept;
    // Appends what happened in a step that jumps.
    void note_jump(const State& before, State& after, std::vector<JumpEvent>& jumps) const;
    void judge_balance(const State& state, Outcome& outcome);
    // True if small rotations leave out too much in this step, which is then told.
    bool outgrows(State& next);

    std::optional<StageOf> stage_;
    Problem problem_;
    Options given_;  // before step control and path_step were chosen
    StepControl control_;
    bool whole_ = false;  // the host has asked for the tangent of a step; committed states keep it
    std::vector<FollowedParameter> followed_;
    std::vector<Pattern> first_patterns_;  // before any history was changed
    std::uint64_t scene_hash_;
    Monitor& monitor_;
    Stepper stepper_;
    PairGraph graph_;
    Outcome initial_outcome_;
    States states_;
    Record record_;
    bool may_turn_ = false;  // to large rotations
    bool warned_of_mixity_ = false;
    Observer observer_;
    Warnings warnings_;
};

// True if a solver of this problem that is made with the other one shares its condensed bodies.
bool share_bodies(const Solver& other, const Problem& problem);

// Returns a value of the state that the solver shows (values.hpp).
inline double value(Solver& solver, const std::string& key) {
    return solver.values(solver.states().shown(), {key}).front();
}

}  // namespace delam
