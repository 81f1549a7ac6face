// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/step/step_control.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "delam/delam.h"

namespace delam {

namespace {

constexpr double sharp_share = 0.75;  // of the change, in half of the time: a jump rather than growth
constexpr int smooth_levels = 2;      // consecutive halvings that halve the change: the change is continuous

// Sum of w |z - z_before|, in units of the mean weight of a pair.
double change_in_pairs(const PairLaws& pairs, const State& before, const State& after) {
    double change = 0.0, weight = 0.0, count = 0.0;
    for (std::size_t p = 0; p < before.adhesion.size(); ++p) {
        if (pairs.law[p] == nullptr) continue;
        change += pairs.weight[p] * std::abs(after.adhesion[p] - before.adhesion[p]);
        weight += pairs.weight[p];
        count += 1.0;
    }
    return weight > 0.0 ? change * count / weight : 0.0;
}

// An instant to be reached, and its state once computed.
struct Goal {
    double time;
    std::unique_ptr<Stepper::Result> reached;  // null: not computed
    double change = 0.0;
    int smooth = 0;
    bool sharp = false;            // nearly all of the change in an interval about twice as long
    std::exception_ptr failure{};  // why it was not reached in one part
};

// One step in parts: the instants yet to be reached lie on a stack, the next one on top.
class Parts {
public:
    Parts(Stepper& stepper, const PairGraph& graph, const State& before, TriedStep whole, const Options& options,
          const StepCuts& cuts)
        : stepper_(stepper),
          graph_(graph),
          options_(options),
          located_(options.jump_tolerance > 0.0 ? options.jump_tolerance : cuts.located),
          cuts_(cuts.cuts),
          step_(before.step + 1),
          asked_(whole.time - before.time),
          at_(before) {
        history_.revised_from = step_;
        goals_.push_back({whole.time, nullptr, 0.0, 0});
        goals_.back().failure = whole.failure;
        if (!whole.result) return;
        history_ = whole.result->state.history;
        at_.step = whole.result->state.step - 1;
        goals_.back().reached = std::make_unique<Stepper::Result>(std::move(*whole.result));
        count(*goals_.back().reached);
        goals_.back().change = change_in_pairs(stepper_.pairs(), at_, goals_.back().reached->state);
    }

    ControlledStep run() {
        while (!goals_.empty()) {
            const bool tried = goals_.back().reached || goals_.back().failure;
            if (!tried && compute())
                accept_parent();
            else if (!halve())
                accept_goal();
        }
        return close();
    }

private:
    Stepper& stepper_;
    const PairGraph& graph_;
    const Options& options_;
    double located_;  // share of the step to which jumps are located; 0: they are not
    bool cuts_;
    std::int64_t step_;
    double asked_;  // length of the whole step
    StepHistory history_;
    State at_;  // end of the parts accepted so far
    std::vector<Goal> goals_;
    std::vector<JumpEvent> jumps_;
    std::vector<StepPart> done_;
    Effort effort_;
    StepOutcome outcome_;
    Ledger sum_;  // of the parts
    std::string searched_;
    bool converged_ = true;
    std::int64_t refused_ = 0;

    void count(const Stepper::Result& computed);
    bool too_long(const Stepper::Result& result, double change) const;
    bool compute();
    bool halve();
    bool jumps(const Goal& goal) const;
    void accept_parent();
    void accept_goal();
    void accept(Goal goal);
    void record_jump(State& next) const;
    ControlledStep close();
};

// While nothing is damaged the work is exact, however wide the band.
bool Parts::too_long(const Stepper::Result& result, double change) const {
    const Ledger& l = result.state.ledger;
    if (cuts_ && ((converged_ && !result.converged) || leaves_open(at_, result.state))) return true;
    if (located_ > 0.0 && cuts_ && leaves_open(at_, result.state, options_.accuracy)) return true;
    return (options_.step_control == "adaptive" &&
            (!result.converged || (change > 0.0 && l.upper - l.lower > options_.step_tolerance * l.scale()))) ||
           (options_.mixity_step_tolerance > 0.0 && l.mixity_error > options_.mixity_step_tolerance);
}

// Whoever asks for a tolerance hears of every change of a size, others of what counts as a jump.
bool Parts::jumps(const Goal& goal) const {
    if (options_.jump_tolerance > 0.0) return goal.change >= options_.jump_size;
    return located_ > 0.0 && may_jump(stepper_.pairs(), graph_, at_, goal.reached->state);
}

void Parts::count(const Stepper::Result& computed) {
    effort_.add(computed.state.effort);
    outcome_.mixity_held += computed.state.outcome.mixity_held;
}

// Computes the state at the next goal. True if the change is continuous up to the goal behind it, which is reached
// already and short enough: then that one is accepted in one part.
bool Parts::compute() {
    Goal& goal = goals_.back();
    try {
        goal.reached = std::make_unique<Stepper::Result>(stepper_.step(at_, goal.time));
    } catch (const Error& error) {
        if (!cuts_ || !delam::too_long(error)) throw;
        goal.failure = std::current_exception();
        return false;
    }
    count(*goal.reached);
    const double longer = goal.change;  // to the same end, from an earlier start
    goal.change = change_in_pairs(stepper_.pairs(), at_, goal.reached->state);
    goal.sharp = goal.change > sharp_share * longer && longer > 0.0;
    if (goals_.size() == 1) return false;
    const Goal& parent = goals_[goals_.size() - 2];
    const double share = parent.change > 0.0 ? goal.change / parent.change : 0.0;
    goal.sharp = goal.sharp || (parent.reached && share > sharp_share);
    goal.smooth = parent.reached && share > 0.25 && share < 0.75 ? parent.smooth + 1 : 0;
    return goal.smooth >= smooth_levels && !too_long(*parent.reached, parent.change);
}

// Puts an instant halfway to the goal before it, if the interval must and can be halved.
bool Parts::halve() {
    const Goal& goal = goals_.back();
    const double length = goal.time - at_.time;
    const double smallest = options_.smallest_step * asked_;
    if (goal.failure && !(length > smallest)) std::rethrow_exception(goal.failure);
    const bool locate =
        !goal.failure && jumps(goal) && (length > located_ * asked_ || (!goal.sharp && length > smallest));
    if (!goal.failure && !locate && !(too_long(*goal.reached, goal.change) && length > smallest)) return false;
    const double middle = at_.time + 0.5 * length;
    if (!(middle > at_.time && middle < goal.time)) {
        if (goal.failure) std::rethrow_exception(goal.failure);
        return false;
    }
    goals_.push_back({middle, nullptr, 0.0, 0});
    return true;
}

void Parts::accept_parent() {
    goals_.pop_back();
    Goal done = std::move(goals_.back());
    goals_.pop_back();
    ++refused_;
    accept(std::move(done));
}

void Parts::accept_goal() {
    Goal done = std::move(goals_.back());
    goals_.pop_back();
    if (jumps(done)) {
        record_jump(done.reached->state);
        jumps_.push_back(describe_jump(stepper_.pairs(), graph_, at_, done.reached->state));
        jumps_.back().step = step_;
    }
    accept(std::move(done));
}

// The jump has been located: the load moves first, at the state before, and then the state jumps.
void Parts::record_jump(State& next) const {
    Ledger& ledger = next.ledger;
    next.jump_within = {};  // bisection tells the instant
    next.outcome.released = std::max(0.0, ledger.upper - ledger.increment);
    ledger.work = at_.ledger.work + ledger.increment + next.outcome.released;
    ledger.released = at_.ledger.released + next.outcome.released;
}

// Adds a part to the step.
void Parts::accept(Goal goal) {
    State& next = goal.reached->state;
    if (!(located_ > 0.0) && delam::jumps(stepper_.pairs(), graph_, at_, next)) {
        jumps_.push_back(describe_jump(stepper_.pairs(), graph_, at_, next));
        jumps_.back().step = step_;
    }
    sum_.add_part(next.ledger, at_.ledger);
    const double margin = next.outcome.search_margin;
    outcome_.search_gap = std::max(outcome_.search_gap, next.outcome.search_gap);
    outcome_.search_margin = done_.empty() ? margin : std::min(outcome_.search_margin, margin);
    converged_ = converged_ && goal.reached->converged;
    done_.push_back({next.time, 0.0});
    searched_ += goal.reached->searched;
    outcome_.released += next.outcome.released;
    outcome_.buckling.add(next.outcome.buckling);
    at_ = std::move(next);
    --at_.step;  // the parts of a step share its number
    // Goals that were tried from the start of this part are invalid from its end.
    for (Goal& other : goals_) {
        if (std::exchange(other.failure, nullptr)) ++refused_;
        if (!other.reached) continue;
        other.reached.reset();
        ++refused_;
    }
}

// The whole step: the last state, with the sums and the effort of all parts.
ControlledStep Parts::close() {
    ++at_.step;
    history_.substeps = static_cast<std::int64_t>(done_.size());
    ControlledStep out{{std::move(at_), converged_, std::move(searched_)}, std::move(jumps_), std::move(done_)};
    State& state = out.result.state;
    state.ledger.take_parts(sum_);
    outcome_.damage_change = state.outcome.damage_change;
    outcome_.jumps = static_cast<std::int64_t>(out.jumps.size());
    history_.refused_steps = refused_;
    state.effort = effort_;
    state.outcome = outcome_;
    state.history = history_;
    return out;
}

}  // namespace

bool may_jump(const PairLaws& pairs, const PairGraph& graph, const State& before, const State& after) {
    return jumps(pairs, graph, before, after) || hides_jump(pairs, graph, before, after);
}

bool too_long(const Error& error) { return error.status() == DELAM_LIMIT; }

ControlledStep controlled_step(Stepper& stepper, const PairGraph& graph, const State& before, TriedStep whole,
                               const Options& options, const StepCuts& cuts) {
    return Parts(stepper, graph, before, std::move(whole), options, cuts).run();
}

}  // namespace delam
