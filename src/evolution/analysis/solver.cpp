// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/analysis/solver.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "base/team.hpp"
#include "evolution/analysis/parts_tangent.hpp"
#include "evolution/analysis/rotation_watch.hpp"
#include "evolution/analysis/take_over.hpp"
#include "evolution/observe/balance.hpp"
#include "evolution/observe/soundness.hpp"
#include "evolution/observe/values.hpp"
#include "evolution/search/fronts.hpp"
#include "evolution/step/backtrack.hpp"
#include "evolution/step/load_path.hpp"
#include "evolution/step/step_control.hpp"
#include "evolution/step/turned/turned_steps.hpp"
#include "scene/advice/scene_warnings.hpp"
#include "scene/check/kinematics.hpp"
#include "scene/check/step_control.hpp"
#include "scene/check/validate_stages.hpp"

namespace delam {

namespace {

// The problem with the step control that its options lead to.
Problem with_used_control(Problem problem) {
    const StepControl control = used_step_control(problem, problem.options);
    problem.options.step_control = control.name;
    problem.options.path_step = control.path_step;
    return problem;
}

std::optional<StageOf> first_stage(const Problem& problem, Monitor& monitor, double time) {
    if (changes_of(problem).empty() && !may_turn(problem)) return {};
    validate_stages(problem, time, [&monitor] { monitor.progress("check", 0, 0); });
    const std::vector<double> none(problem.constraints.size(), 0.0);
    return StageOf{std::make_shared<const Problem>(problem), {time, none, none}, next_change(problem, time)};
}

// Constraints that end before the analysis, or begin in it, do not hold in the first scene.
Problem scene_at(const Problem& problem, double time) {
    return changes_of(problem).empty() && !may_turn(problem) ? problem : scene_from(problem, time);
}

// True if rotations are large.
bool turns(const Problem& problem) { return problem.options.kinematics != "linear"; }

// Returns the operator that reads the states, after bodies that rotate have got steps of their own.
const JumpOperator& reading_operator(Stepper& stepper, const Problem& problem, Monitor& monitor) {
    if (turns(problem)) delegate_to_turned_steps(stepper, problem, monitor);
    return stepper.op();
}

// The part of the minimisation that did not come to its end, with its measure and limit.
std::string what_did_not_converge(const State& state, const Options& options) {
    const Effort& effort = state.effort;
    const StepOutcome& outcome = state.outcome;
    const std::string after = text(" after ", effort.am_iterations, " alternate minimisation ",
                                   effort.am_iterations == 1 ? "iteration" : "iterations");
    const std::string change =
        text("last change of adhesion ", outcome.damage_change, ", tolerance ", options.damage_tolerance);
    if (outcome.turned_off > 0.0)
        return text("nodal forces are out of balance by ", outcome.turned_off, " of the load after ",
                    effort.linearisations, " linearisations of bodies that rotate, tolerance ",
                    options.limits.turned_balance, ": smaller load steps may help");
    if (outcome.damage_change > options.damage_tolerance)
        return text("the adhesion still changes", after, " (", change,
                    "; minimisation_limit = ", options.minimisation_limit, ")");
    const std::string rest = text("; the adhesion is at rest", after, " (", change, ")");
    if (outcome.mixity_held > 0)
        return text("the mixity of ", outcome.mixity_held, " pairs did not converge and was held fixed", rest);
    const std::string where = "a displacement step at fixed adhesion did not converge";
    if (!state.response.converged)
        return text(where, ": the iterative linear solve leaves a relative residual of ", effort.linear_residual,
                    ", tolerance ", options.linear_tolerance, rest);
    if (effort.contact_iterations_max >= options.contact_limit)
        return text(where, ": the contact set still changes after ", effort.contact_iterations_max,
                    " active-set steps (contact_limit = ", options.contact_limit, ")", rest);
    if (effort.am_iterations >= options.minimisation_limit)
        return text("the mixity still changes (minimisation_limit = ", options.minimisation_limit, ")", rest);
    return text(where, ": its linear solves and its contact set did; the tractions of the pairs still change", rest);
}

}  // namespace

// problem: the scene of the stage. hash: of that of the host.
Solver::Solver(std::optional<StageOf> stage, const Problem& problem, std::uint64_t hash, Monitor& monitor,
               const Solver* other)
    : stage_(std::move(stage)),
      problem_(with_used_control(problem)),
      given_(problem.options),
      control_(used_step_control(problem, problem.options)),
      first_patterns_(problem.patterns),
      scene_hash_(hash),
      monitor_(monitor),
      stepper_(problem_, monitor, Stepper::Checks::made_here, other != nullptr ? &other->stepper_ : nullptr),
      graph_(problem_.mesh->interfaces()),
      states_(keeps_past(problem_.options) ? problem_.options.backtracking_depth : 0),
      may_turn_(stage_ && may_turn(*stage_->whole) && !stage_->stage.rotates &&
                unknown_to_rotations(*stage_->whole).empty()),
      observer_(problem_, reading_operator(stepper_, problem_, monitor), stepper_.pairs(), stepper_.contact(),
                stepper_.initial_adhesion(), stepper_.design().in_engine),
      warnings_(problem_, monitor) {}

Solver::Solver(const Problem& problem, Monitor& monitor, double time, const Solver* other)
    : Solver(first_stage(problem, monitor, time), scene_at(problem, time), hash(problem), monitor, other) {
    begin(time);
    warn_of_scene(problem_, monitor_);
    const std::int64_t threads = problem_.options.threads;
    if (threads > processors())
        monitor_.log(1, text("option threads = ", threads, ": ", useful_threads(threads),
                             " are used, the number of processors of this process"));
}

void Solver::begin(double time) {
    Stepper::Result first = stepper_.initial(time);
    states_.restore(std::move(first.state), {}, {});
    const State& initial = states_.committed();
    observer_.show(initial);
    if (!first.converged) initial_outcome_ = unconverged_displacement(initial);
    require_sound(problem_, initial, first.converged);
    judge_balance(initial, initial_outcome_);
}

Solver::Solver(StageOf stage, const Solver& before, std::span<const double> displacement)
    : Solver(stage, scene_of(*stage.whole, stage.stage), before.scene_hash_, before.monitor_, nullptr) {
    if (displacement.empty()) {
        begin(stage.stage.from);
        return;
    }
    const State& there = before.states_.committed();
    const std::string what = stage.stage.rotates ? "a stage with large rotations begins: " : "supports begin or end: ";
    problem_.patterns = before.problem_.patterns;
    Stepper::Result begun = take_over(stepper_, there, displacement, turns(before.problem_), turns(problem_));
    if (!begun.converged) fail(DELAM_ERROR_NUMERICAL, what, unconverged_displacement(there).text);
    require_sound(problem_, begun.state, true);
    adopt(chosen(begun.state.growth.way, begun.state.ledger.dissipated, false));
    whole_ = before.whole_;
    states_.restore(std::move(begun.state), {}, before.states_.jumps());
    record_ = before.record_;
    warned_of_mixity_ = before.warned_of_mixity_;
    warnings_.go_on_from(before.warnings_);
    observer_.show(states_.committed());
    Outcome balance;
    judge_balance(states_.committed(), balance);
    if (balance.status != 0) fail(DELAM_ERROR_NUMERICAL, what, balance.text);
}

bool share_bodies(const Solver& other, const Problem& problem) {
    return shares_bodies(problem, other.stepper().design());
}

Outcome Solver::unconverged_displacement(const State& state) const {
    return {DELAM_NOT_CONVERGED, text("displacements at time ", state.time, ": not converged (worst linear residual ",
                                      state.effort.linear_residual, ", tolerance ", problem_.options.linear_tolerance,
                                      "; ", state.effort.contact_iterations, " active-set steps)")};
}

// Chooses the step control anew, where more is known than the options. way, dissipated: of the committed state.
Solver::Chosen Solver::chosen(std::int64_t way, double dissipated, bool follows) const {
    std::string whole;
    if (follows) whole = "derivatives by numbers of the laws are followed";
    if (way == 2) whole = "the host has asked for the tangent of a step";
    if (way == 0 && dissipated > 0.0 && !turns(problem_)) whole = "so were the steps before";
    Chosen next{used_step_control(problem_, given_, whole), problem_.options};
    next.options.step_control = next.control.name;
    next.options.path_step = next.control.path_step;
    return next;
}

void Solver::adopt(Chosen next) noexcept {
    control_ = std::move(next.control);
    problem_.options = std::move(next.options);
}

void Solver::judge_balance(const State& state, Outcome& outcome) {
    const double off = Balance(problem_, stepper_.op(), stepper_.contact(), stepper_.pairs(), state).off();
    if (!(off > poor_balance)) return;
    const std::string what =
        text("step ", state.step, " at time ", state.time, ": nodal forces are out of balance by ", off,
             " of the largest reaction, because digits of the stiffness are lost to rounding (plies much longer than "
             "thick, or moduli that differ by many orders of magnitude)");
    if (off > no_balance) {
        outcome = {DELAM_NOT_CONVERGED,
                   text(outcome.text, outcome.text.empty() ? "" : "; ", what, "; allowed: up to ", no_balance)};
    } else {
        warnings_.report_balance(what);
    }
}

void Solver::require_nothing_pending(double time) const {
    if (states_.pending() != nullptr) fail(DELAM_ERROR_STATE, "a step is pending: commit it or roll it back first");
    if (!std::isfinite(time)) fail(DELAM_ERROR_ARGUMENT, "time = ", time, " must be finite");
}

void Solver::require_in_stage(double time) const {
    if (stage_ && (time < stage_->stage.from || time > stage_->until))
        fail(DELAM_ERROR_ARGUMENT, "time ", time, " lies beyond time ",
             time > stage_->until ? stage_->until : stage_->stage.from,
             ", at which supports begin or end: advance to that time first");
}

void Solver::note_jump(const State& before, State& after, std::vector<JumpEvent>& jumps) const {
    if (!delam::jumps(stepper_.pairs(), graph_, before, after)) return;
    jumps.push_back(describe_jump(stepper_.pairs(), graph_, before, after));
    after.outcome.jumps = 1;
}

Outcome Solver::advance(double time) {
    require_nothing_pending(time);
    const State& committed = states_.committed();
    if (time <= committed.time)
        fail(DELAM_ERROR_ARGUMENT, "time ", time, " is not after the committed time ", committed.time);
    require_in_stage(time);
    const Options& options = problem_.options;
    Chain chain(states_.past(), committed);
    std::optional<Stepper::Result> whole;
    std::exception_ptr failure;  // of a step that may be cut
    PendingStep pending;
    const bool cuts = turns(problem_) && (control_.located > 0.0 || options.step_control == "adaptive");
    if (follows_load(options) && !turns(problem_)) {
        ControlledStep followed = followed_step(stepper_, graph_, committed, time, options);
        whole = std::move(followed.result);
        pending.jumps = std::move(followed.jumps);
        pending.parts = std::move(followed.parts);
    } else if (keeps_past(options)) {
        whole = backtracked_step(stepper_, chain, committed.step, time, options);
    } else {
        try {
            whole = stepper_.step(committed, time);
        } catch (const Error& error) {
            if (!cuts || !too_long(error)) throw;
            failure = std::current_exception();
        }
    }
    for (auto& [step, state] : chain.revised()) note_jump(chain.at(step - 1), state, pending.jumps);
    const State& from = chain.at(committed.step);
    const bool cut = cuts && (!whole || !whole->converged);
    const bool halved = cut || (control_.located > 0.0 && (may_jump(stepper_.pairs(), graph_, from, whole->state) ||
                                                           leaves_open(from, whole->state, options.accuracy)));
    Stepper::Result result;
    if (controls_steps(options) || halved) {
        ControlledStep controlled = controlled_step(stepper_, graph_, from, {time, std::move(whole), failure}, options,
                                                    {control_.located, cuts});
        result = std::move(controlled.result);
        pending.parts = std::move(controlled.parts);
        std::ranges::move(controlled.jumps, std::back_inserter(pending.jumps));
    } else {
        result = std::move(*whole);
        if (!follows_load(options) || turns(problem_)) note_jump(from, result.state, pending.jumps);
    }
    pending.state = std::move(result.state);
    if (whole_) pending.state.growth.way = 2;
    pending.searched = std::move(result.searched);
    for (auto& [step, state] : chain.revised()) pending.revised.push_back(std::move(state));
    require_sound(problem_, pending.state, result.converged);
    for (const State& revised : pending.revised) require_sound(problem_, revised, result.converged);
    warned_of_mixity_ = warned_of_mixity_ || stepper_.warn(pending.state);
    if (may_turn_ && followed_.empty() && outgrows(pending.state)) {
        states_.propose(std::move(pending));
        observer_.show(states_.present());
        return {DELAM_OK, "", true};
    }
    warnings_.judge_front(observer_, committed, pending.state);
    warnings_.judge_ledger(pending.state, options);
    warnings_.judge_symmetry(graph_, committed, pending.state);
    warnings_.tell_buckling(pending.state);
    Outcome outcome;
    if (!result.converged)
        outcome = {DELAM_NOT_CONVERGED, text("step ", pending.state.step, " at time ", time,
                                             ": not converged: ", what_did_not_converge(pending.state, options))};
    judge_balance(pending.state, outcome);
    states_.propose(std::move(pending));
    observer_.show(states_.present());
    return outcome;
}

bool Solver::outgrows(State& next) {
    const State& committed = states_.committed();
    // The observer keeps what it recovers of the state that it shows, which lives no longer than this step.
    struct Back {
        Observer& observer;
        const State& shown;
        ~Back() { observer.show(shown); }
    };
    const Back back{observer_, committed};
    observer_.show(next);
    const std::string why = judge_rotations(observer_, committed, next);
    if (!why.empty())
        monitor_.log(1, text("step ", next.step, " at time ", next.time, ": ", why, "; from time ", committed.time,
                             " on rotations are large (kinematics = auto)"));
    return !why.empty();
}

Outcome Solver::equilibrate(double time, std::span<const double> adhesion) {
    require_nothing_pending(time);
    require_in_stage(time);
    Stepper::Result result = stepper_.equilibrate(states_.committed(), time, adhesion);
    Outcome outcome;
    if (!result.converged) outcome = unconverged_displacement(result.state);
    require_sound(problem_, result.state, result.converged);
    judge_balance(result.state, outcome);
    states_.propose({std::move(result.state), {}, {}, {}, {}});
    observer_.show(states_.present());
    return outcome;
}

void Solver::commit() {
    const PendingStep* pending = states_.pending();
    if (pending == nullptr) fail(DELAM_ERROR_STATE, "nothing to commit: no step is pending");
    const std::vector<std::string> keys = record_.keys();
    std::vector<Record::Row> rows;
    for (const State& state : pending->revised) rows.push_back({state.step, values(state, keys)});
    rows.push_back({pending->state.step, values(pending->state, keys)});
    record_.reserve_row();
    const bool present_shown = !states_.selected();
    states_.commit();
    // From here on nothing can fail.
    for (const Record::Row& row : rows) record_.put(row);
    if (present_shown)
        observer_.follow(states_.committed());  // the pending state, which is the committed one now
    else
        observer_.show(states_.committed());
}

void Solver::rollback() {
    if (states_.pending() == nullptr) fail(DELAM_ERROR_STATE, "nothing to roll back: no step is pending");
    states_.rollback();
    observer_.show(states_.committed());
}

void Solver::set_history(std::int64_t pattern, std::span<const double> times, std::span<const double> values) {
    if (states_.pending() != nullptr)
        fail(DELAM_ERROR_STATE, "a step is pending: commit it or roll it back before a history changes");
    const double now = states_.committed().time;
    if (times.front() <= now)
        fail(DELAM_ERROR_ARGUMENT, "times[0] = ", times.front(), " is not after the committed time ", now);
    Pattern& changed = problem_.patterns[index(pattern)];
    std::vector<double> t, v;
    for (std::size_t i = 0; i < changed.times.size() && changed.times[i] < now; ++i) {
        t.push_back(changed.times[i]);
        v.push_back(changed.values[i]);
    }
    t.push_back(now);
    v.push_back(changed.at(now));
    t.insert(t.end(), times.begin(), times.end());
    v.insert(v.end(), values.begin(), values.end());
    changed.times = std::move(t);
    changed.values = std::move(v);
}

void Solver::record(const std::string& key) {
    if (states_.pending() != nullptr)
        fail(DELAM_ERROR_STATE, "a step is pending: commit it or roll it back before a value is recorded");
    if (const char* why = why_unrecorded(key)) fail(DELAM_ERROR_ARGUMENT, "value '", key, "' is not recorded: ", why);
    const std::string own = value_key(key);
    const State& committed = states_.committed();
    if (record_.find(own) == nullptr) record_.add(own, committed.step, values(committed, {own}).front());
}

std::vector<double> Solver::values(const State& state, const std::vector<std::string>& keys) {
    std::vector<double> values = values_of(observer_, state, keys);
    for (std::size_t i = 0; i < keys.size(); ++i)
        if (const ValueInfo* info = find_value(keys[i]); info != nullptr && info->key == std::string_view(rotation_key))
            warnings_.judge_rotation(state, values[i]);
    return values;
}

std::vector<double> Solver::step_tangent() {
    const PendingStep* pending = states_.pending();
    if (pending == nullptr || pending->state.step == states_.committed().step)
        fail(DELAM_ERROR_STATE, "step tangent: no step is pending");
    if (!pending->revised.empty())
        fail(DELAM_ERROR_STATE, "step tangent: not available, because backtracking has replaced the steps from ",
             pending->revised.front().step, " on");
    if (pending->parts.size() > 1 || (turns(problem_) && pending->state.history.substeps > 1)) {
        if (turns(problem_)) take_whole_steps();  // so that the step has a tangent once it is taken again
        if (keeps_past(problem_.options) || turns(problem_))
            fail(DELAM_ERROR_STATE, "step tangent: not available, because the step was divided into ",
                 pending->state.history.substeps,
                 " substeps (step_control, jump_tolerance or mixity_step_tolerance), with a search "
                 "(solution = energetic), backtracking or large rotations in each");
        return parts_tangent(stepper_, problem_.patterns, states_.committed(), pending->parts);
    }
    return stepper_.step_tangent(states_.committed(), pending->state);
}

void Solver::take_whole_steps() {
    if (given_.step_control != "auto" || !(follows_load(problem_.options) || control_.located > 0.0)) return;
    adopt(chosen(2, 0.0, false));
    states_.take_whole_steps();
    whole_ = true;
}

std::int64_t Solver::follow(std::span<const std::int64_t> interfaces, const std::string& key) {
    if (turns(problem_))
        fail(DELAM_ERROR_STATE, "sensitivities are not followed with kinematics = ", problem_.options.kinematics);
    if (stage_ && !changes_of(*stage_->whole).empty())
        fail(DELAM_ERROR_STATE, "sensitivities are not followed where supports begin or end");
    const State& committed = states_.committed();
    if (states_.pending() != nullptr || committed.step != 0)
        fail(DELAM_ERROR_STATE, "sensitivities are followed from the initial state on: there are steps already");
    std::vector<FollowedParameter> parameters = followed_;
    parameters.push_back(followed_parameter(problem_, interfaces, key));
    Chosen next = chosen(committed.growth.way, committed.ledger.dissipated, true);
    states_.set_sensitivity(stepper_.follow(parameters, committed));
    followed_ = std::move(parameters);
    adopt(std::move(next));
    return static_cast<std::int64_t>(followed_.size()) - 1;
}

std::vector<double> Solver::sensitivities() const {
    const std::size_t patterns = problem_.patterns.size(), count = followed_.size();
    const std::vector<double>& by = states_.shown().sensitivity.conjugate;
    if (by.size() != count * patterns)
        fail(DELAM_ERROR_STATE,
             "sensitivities are not known in a state that was loaded or set: they are followed from "
             "the initial state on");
    std::vector<double> matrix(by.size());
    for (std::size_t k = 0; k < count; ++k)
        for (std::size_t p = 0; p < patterns; ++p) matrix[p * count + k] = by[k * patterns + p];
    return matrix;
}

void Solver::select(std::int64_t step) {
    states_.select(step);
    observer_.show(states_.shown());
}

void Solver::restore(State restored, std::vector<State> past, std::vector<JumpEvent> jumps,
                     std::vector<Pattern> patterns, Record record) {
    Chosen next = chosen(restored.growth.way, restored.ledger.dissipated, !followed_.empty());
    stepper_.recall(restored);
    problem_.patterns = std::move(patterns);
    states_.restore(std::move(restored), std::move(past), std::move(jumps));
    record_ = std::move(record);
    whole_ = false;
    adopt(std::move(next));
    observer_.show(states_.committed());
}

}  // namespace delam
