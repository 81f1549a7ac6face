// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/step/load_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "evolution/minimise/proportional_loads.hpp"
#include "evolution/path/advance.hpp"
#include "evolution/step/growth_events.hpp"
#include "scene/advice/expected_parts.hpp"
#include "scene/advice/process_zone.hpp"

namespace delam {

namespace {

constexpr double popping_pairs = 1.0;      // on a front, that a part of mixed mode dissipates where pairs pop
constexpr double softening_of_part = 0.5;  // of the pairs that soften in one mode, before any of them is spent
constexpr double same_rate = 3.0;          // times the rate of the part before: the growth goes on as it did
constexpr double allowance = 1.2;          // times what a part should dissipate
// Up to this rise of ln M, the work of a part that damages few pairs in one mode is taken as it is. A first step from
// zero load damages few pairs too, while the load becomes several times as large. (Measured by delam run
// examples/dcb-alfano/dcb-alfano.toml --set solver.step_control=load --set time.steps=40: a third takes 560 instead of
// 369 iterations, twice changes no digit.)
constexpr double steady_rise = 0.35;
// A part of few pairs that leaves more open than it dissipates holds a jump, and so may one after which nothing adheres
// between fronts. (Measured by delam run on a DCB with two notches, 5 mm apart, in 10 and 30 steps, whose ligament
// releases 1.7 times what it dissipates, and on examples/dcb-alfano with 200 and 100 cells: half and twice change no
// digit; a quarter locates single pops, with 418 instead of 72 iterations.)
constexpr double one_off = 1.0;
// Rise of ln M in a part that jumps, which is the error of the load of the jump. (Measured by delam run on a bar that
// snaps back, in 7 steps, and a DCB under dead forces, in 3: half moves these loads by 0.1 % with 1.0 times the
// iterations, twice by 0.2 % with 0.7; a film that comes off takes 1265, 1265 and 780. The flattest one, a DCB under
// moments, moves by 1.4 % with half.)
constexpr double located = 0.003;
constexpr double telling_part = 0.25;  // pairs on a front: less of an advance does not tell how a front grows
// Single pairs of mixed mode that release a larger share of what they dissipate pop, and are followed one by one at
// their own load; growth that is resolved releases less, by the error of its parts. (Measured by delam run on
// single-leg bending in 10 and 40 steps, zone of 9 and 8 pairs, and on mixed-mode bending, mixity .2, cells of .2 mm,
// zone of 3.3 pairs. The former dissipates 6.165 and 6.624, open 3.0e-3 and 2.4e-3; half of it gives 6.175 and 6.647,
// 4e-4 and 7e-4, twice 6.162 and 6.622, 3.5e-3 and 2.7e-3; 2560 steps 6.167 and 6.629. The latter leaves 5e-6 open in
// 384 substeps with each of them, and 2.5e-2 in 1812 with five times as much.)
constexpr double set_free = 0.01;
// The release of so many single pairs is measured; earlier ones count less. They average over the pops, which parts cut
// anywhere. (Measured by the same run: half and twice take 369 and 397 iterations instead of 369, and move what stays
// open, 2.6e-3 of the dissipated energy, by 2e-4.)
constexpr double most_told = 20.0;
constexpr int most_refused = 40;          // parts in a row; then one is kept, however far it goes
constexpr double steps_per_octave = 4.0;  // of the lengths of parts

// The instants of a part.
struct Plan {
    double start;     // from which on pairs may be damaged
    double reach;     // end of the part
    double shortest;  // that changes anything beyond the tolerance of the minimisation
};

// A part that may be kept.
struct Trial {
    Stepper::Result result;
    GrowthPart part;
    double stride;
    double own = 0.0;      // length of the part in which pairs may be damaged
    bool damages = false;  // beyond what a minimisation leaves open
    bool settled = true;   // damage and mixities have converged
    bool one_mode = false;
    double limit = 0.0;  // area that it may dissipate
};

// Returns how much larger the load of the state after is, as ln M with E = M^2 / 2 at the jumps and the damage before:
// the factor of the loads where they grow in proportion. Infinity: the energy does not tell it.
double load_rise(const Stepper& stepper, const State& before, const State& after, double base) {
    if (const std::optional<double> a = load_ratio(before.theta, after.theta)) return -std::log(*a);
    const double from = base + before.ledger.energy(), to = from + stepper.held_rise(before, after.theta);
    return from * to > 0.0 ? 0.5 * std::abs(std::log(to / from)) : std::numeric_limits<double>::infinity();
}

// Returns the next shorter of the lengths of parts. They are few, so that rounding in the states, and what their
// minimisation leaves open, cannot change the parts little by little.
double length_of_part(double length) {
    return std::exp2(std::floor(std::log2(length) * steps_per_octave + 0.01) / steps_per_octave);
}

bool tells(const Advance& advance) { return advance.area > telling_part * advance.row; }

// Returns the factor on the length of a part that dissipated `times` what it should. A part that is far too long may
// end in one of several states, so that its end tells little.
double shorter(double times) { return times > 10.0 ? 0.125 : times > 2.5 ? 0.25 : 0.5; }
constexpr double far_too_long = 5.0;  // times: a part whose mixities did not settle is cut to a quarter
// So often; then it is followed in parts at its own load, in which they settle. (Measured by
// verify/cases/load_path/settling.py: half and twice take 603 and 678 alternations instead of 658, and move what is
// dissipated by 3e-5 at most. With none, mixed-mode bending of mixity .5
// with cells of .2 mm takes 6044 instead of 1638 iterations, and leaves 5.5e-3 of the dissipated energy open.)
constexpr int most_unsettled = 2;

class LoadPath {
public:
    LoadPath(Stepper& stepper, const PairGraph& graph, const State& before, double end, const Options& options,
             double base)
        : stepper_(stepper),
          options_(options),
          base_(base),
          begin_(before.time),
          end_(end),
          at_(before),
          graph_(graph),
          events_(stepper.pairs(), graph),
          growth_(before.growth),
          popping_(before.growth.pop_time > 0.0),
          popped_(popping_) {
        history_.revised_from = before.step + 1;
        least_rise_ = 10.0 * options.damage_tolerance;
    }

    ControlledStep run() {
        while (at_.time < end_) advance();
        return close();
    }

private:
    Plan plan() const;
    void advance();
    double wanted(const Advance& advance, bool one_mode) const;
    Trial attempt(const Plan& plan, bool along_path);
    std::optional<Trial> attempt_below_limit(Plan& plan, bool along_path);
    bool goes_on(const Trial& trial) const;
    bool short_enough(const Trial& trial) const;
    bool pops(const Trial& trial, const Plan& plan) const;
    void learn(const Trial& trial, const Plan& plan, bool pops);
    void accept(Trial trial);
    double work(const State& next, double start) const;
    double freed(const Trial& trial) const;
    void tell(const Trial& trial);
    ControlledStep close();

    Stepper& stepper_;
    const Options& options_;
    double base_;  // followed_step()
    double begin_, end_;
    State at_;  // end of the parts accepted so far
    const PairGraph& graph_;
    GrowthEvents events_;
    Growth growth_;
    bool popping_, popped_;  // pairs pop; the last part took one
    bool resolved_ = true;
    double least_rise_ = 0.0;
    double last_pop_ = -std::numeric_limits<double>::infinity();
    bool converged_ = true;
    std::string searched_;
    Effort effort_;
    StepOutcome outcome_;
    StepHistory history_{0, 0, 0, 0, 0};
    std::vector<StepPart> parts_;
    Ledger sum_;
};

Plan LoadPath::plan() const {
    const double length = end_ - at_.time;
    Plan plan{at_.time, end_, 0.0};
    const std::optional<double> a = at_.loaded != 0 ? load_ratio(at_.theta, stepper_.factors(end_)) : std::nullopt;
    if (a && *a < 1.0) {
        const double per_rise = *a / (1.0 - *a) * length;  // time over dM/M
        const double margin = load_margin(stepper_.pairs(), at_) - 1.0;
        plan.shortest = least_rise_ * per_rise;
        if (margin > 0.1 * least_rise_) plan.start = std::min(end_, at_.time + margin * per_rise);
    }
    if (popping_ && growth_.pop_time > 0.0)
        plan.reach = at_.time + length_of_part(growth_.pop_time * (popped_ ? 1.0 : 0.3));
    else if (growth_.part_time > 0.0)
        plan.reach = plan.start + length_of_part(growth_.part_time);
    plan.reach = std::min(end_, std::max(plan.reach, plan.start + plan.shortest));
    return plan;
}

double LoadPath::wanted(const Advance& advance, bool one_mode) const {
    if (!advance.fronts) return (one_mode ? softening_of_part : options_.path_step) * advance.zone;
    if (!one_mode && !popping_) return advance_of_part(options_.path_step, advance.row, advance.zone);
    return std::max((one_mode ? pairs_of_jump : popping_pairs) * advance.row, options_.path_step * advance.zone);
}

// Work of the reactions, by the trapezoidal rule from the first damage on: up to there, reactions grow with the load.
double LoadPath::work(const State& next, double start) const {
    const double length = next.time - at_.time, undamaged = start > at_.time ? (start - at_.time) / length : 0.0;
    const std::optional<double> a = undamaged > 0.0 ? load_ratio(at_.theta, next.theta) : std::nullopt;
    double sum = 0.0;
    for (std::size_t p = 0; p < next.theta.size(); ++p) {
        const double from = at_.response.conjugate[p], to = next.response.conjugate[p];
        const double change = next.theta[p] - at_.theta[p], split = a ? undamaged : 0.0;
        const double between = a ? from * (1.0 + split * (1.0 / *a - 1.0)) : from;
        sum += 0.5 * change * (split * (from + between) + (1.0 - split) * (between + to));
    }
    return sum;
}

// Computes a part. along_path: it is followed in parts at its own load.
Trial LoadPath::attempt(const Plan& plan, bool along_path) {
    const double stride = along_path ? options_.path_step : 1.0;
    Trial trial{stepper_.step(at_, plan.reach, {}, stride), {}, stride};
    const State& next = trial.result.state;
    effort_.add(next.effort);
    trial.settled = trial.result.converged && next.outcome.mixity_held == 0;
    trial.own = std::max(plan.reach - plan.start, 0.0);
    trial.part = {advance_between(stepper_.pairs(), graph_, stepper_.initial_adhesion(), at_, next),
                  load_rise(stepper_, at_, next, base_) * trial.own / (plan.reach - at_.time),
                  std::min(plan.start, plan.reach), false};
    trial.damages = trial.part.advance.zone > 0.0;
    if (!trial.damages) {
        trial.part.advance = {};
        return trial;
    }
    trial.one_mode = stepper_.one_mode(at_, next);
    trial.limit = wanted(trial.part.advance, trial.one_mode);
    return trial;
}

// Returns nothing where a part has no equilibrium, because dead loads exceed what adhesion, supports and contact hold,
// and sets a shorter one, until the limit load is known.
std::optional<Trial> LoadPath::attempt_below_limit(Plan& plan, bool along_path) {
    try {
        return attempt(plan, along_path);
    } catch (const Error& error) {
        if (error.status() != DELAM_LIMIT) throw;
        const double from = std::max(plan.start, at_.time), left = plan.reach - from;
        const bool known = left <= std::max(plan.shortest, located * std::max(std::abs(from), end_ - begin_));
        if (!known || (plan.start > at_.time && left > 0.0)) {
            plan.reach = known ? plan.start : from + length_of_part(0.5 * left);
            return {};
        }
        std::string factors;
        for (const double factor : at_.theta) factors += text(factors.empty() ? " " : ", ", factor);
        fail(DELAM_LIMIT, error.what(), "; the state before holds up to time ", at_.time, ", where the factors are",
             factors);
    }
}

// One mode grows on as in the part before.
bool LoadPath::goes_on(const Trial& trial) const {
    return trial.one_mode && growth_.rate > 0.0 &&
           trial.part.advance.area <= same_rate * growth_.rate * trial.part.rise;
}

// One mode dissipates the same on any path, but its work is that of the trapezoidal rule. From a state without jumps
// on, no ratio of loads tells the work up to the first damage, so that a part without damage comes first. In mixed
// mode, parts that are short enough for what they dissipate are so for their work, too, once the first zone has formed.
bool LoadPath::short_enough(const Trial& trial) const {
    if (at_.loaded == 0) return false;
    if (flat(trial.part)) return single_pairs(trial.part.advance) || trial.part.rise <= located;
    const Advance& advance = trial.part.advance;
    const double area = advance.area;
    const Ledger& next = trial.result.state.ledger;
    const double dissipated = next.dissipated - at_.ledger.dissipated;
    if (!trial.one_mode) {
        // Until the first zone is spent, the reactions bend most, while little is dissipated.
        const double of_zone = dissipated * advance.zone / area;
        const double left = next.increment - work(trial.result.state, trial.part.start);
        const bool closes = next.dissipated > of_zone || std::abs(left) <= options_.accuracy * of_zone;
        return area <= allowance * trial.limit && closes;
    }
    const double open = next.increment + freed(trial) * dissipated - work(trial.result.state, trial.part.start);
    // The errors of parts have either sign; what counts is their sum.
    const bool closes = std::abs(open) <= options_.accuracy * dissipated ||
                        std::abs(at_.ledger.defect() + open) <= options_.accuracy * next.dissipated;
    const bool steady = trial.part.rise <= steady_rise;
    const double pairs_on_fronts = advance.fronts ? pairs_of_jump : 0.0;
    const double least = std::max(wanted(trial.part.advance, false), pairs_on_fronts * advance.row);
    const bool whole = !trial.part.advance.met && std::abs(open) <= one_off * dissipated;
    const bool few = steady && whole && area <= allowance * least;
    return (goes_on(trial) || area <= allowance * trial.limit) && (closes || few);
}

// Returns which share of what a part of one mode dissipates it releases, because pairs pop: the share of single pairs.
// Less than `accuracy` may as well be the error of the work.
double LoadPath::freed(const Trial& trial) const {
    if (!trial.one_mode || !trial.part.advance.fronts || flat(trial.part) || !(growth_.told_dissipated > 0.0))
        return 0.0;
    const double share = growth_.told_released / growth_.told_dissipated;
    return share > 0.5 * options_.accuracy ? share : 0.0;
}

// Single pairs of one mode tell what they release, whichever way their parts cut the sequence of pops.
void LoadPath::tell(const Trial& trial) {
    if (!trial.one_mode || !trial.part.advance.fronts || flat(trial.part) || !single_pairs(trial.part.advance)) return;
    const Ledger& next = trial.result.state.ledger;
    if (growth_.told_pairs > most_told) {
        growth_.told_pairs *= 0.5;
        growth_.told_dissipated *= 0.5;
        growth_.told_released *= 0.5;
    }
    growth_.told_pairs += trial.part.advance.area / trial.part.advance.row;
    growth_.told_dissipated += next.dissipated - at_.ledger.dissipated;
    growth_.told_released += work(trial.result.state, trial.part.start) - next.increment;
}

// True if a part takes a pair that the mesh lets pop.
bool LoadPath::pops(const Trial& trial, const Plan& plan) const {
    const Advance& advance = trial.part.advance;
    const Ledger& next = trial.result.state.ledger;
    const double dissipated = next.dissipated - at_.ledger.dissipated;
    const bool releases = work(trial.result.state, plan.start) - next.increment > set_free * dissipated;
    return tells(advance) && single_pairs(advance) && (!resolved_ || flat(trial.part) || (!trial.one_mode && releases));
}

// Makes parts from the present state, shorter and shorter, until one may be kept.
void LoadPath::advance() {
    Plan plan = this->plan();
    bool along_path = popping_;
    for (int refused = 0, unsettled = 0;; ++refused) {
        plan.reach = std::max(plan.reach, std::nextafter(at_.time, end_));
        std::optional<Trial> below = attempt_below_limit(plan, along_path);
        if (!below) {
            ++history_.refused_steps;
            continue;
        }
        Trial trial = std::move(*below);
        if (!trial.damages && !trial.settled && !along_path) trial = attempt(plan, along_path = true);
        if (!trial.damages) {
            if (growth_.part_time > 0.0) growth_.part_time = std::max(growth_.part_time, 4.0 * trial.own);
            return accept(std::move(trial));
        }
        const bool last = refused > most_refused || trial.own < plan.shortest;
        if (tells(trial.part.advance)) resolved_ = trial.part.advance.zone > resolving_pairs * trial.part.advance.row;
        const bool path_decides = short_enough(trial) && !trial.one_mode && (flat(trial.part) || pops(trial, plan));
        const bool stuck = !trial.settled && (last || (unsettled++ >= most_unsettled && short_enough(trial)));
        if (!along_path && (path_decides || stuck)) {
            // Its path decides what it dissipates, or whether its mixities settle.
            if (Trial finer = attempt(plan, true); finer.settled) {
                along_path = true;
                trial = std::move(finer);
            }
        }
        if (last || (trial.settled && short_enough(trial))) {
            const bool popped = pops(trial, plan);
            popping_ = popping_ || popped;
            trial.part.pops = popping_;
            learn(trial, plan, popping_ && tells(trial.part.advance));
            return accept(std::move(trial));
        }
        ++history_.refused_steps;
        growth_.pop_time *= 0.5;
        const double times = trial.settled ? trial.part.advance.area / trial.limit : far_too_long;
        plan.reach = plan.start + length_of_part(trial.own * shorter(times));
    }
}

// Plans the next part from this one.
void LoadPath::learn(const Trial& trial, const Plan& plan, bool pops) {
    const GrowthPart& part = trial.part;
    growth_.part_time = trial.own * std::clamp(trial.limit / part.advance.area, goes_on(trial) ? 4.0 : 0.2, 4.0);
    if (part.rise > 0.0 && std::isfinite(part.rise) && !flat(part)) growth_.rate = part.advance.area / part.rise;
    popped_ = pops;
    if (popping_ && !pops) growth_.pop_time *= 1.6;
    if (!pops) return;
    growth_.pop_time = std::isfinite(last_pop_) ? plan.reach - last_pop_ : growth_.pop_time;
    last_pop_ = plan.reach;
}

// Records the part. The work of a flat one is that at the damage before.
void LoadPath::accept(Trial trial) {
    Stepper::Result& result = trial.result;
    GrowthPart& part = trial.part;
    State& next = result.state;
    Ledger& ledger = next.ledger;
    // Where nothing is damaged, the work may have been integrated over changes of the contact.
    const bool known = !(part.advance.area > 0.0) || (part.pops && !flat(part) && next.jump_within.known != 0);
    if (!known) {
        const bool moves_first = flat(part) && load_ratio(at_.theta, next.theta);
        const double own = moves_first ? ledger.upper : work(next, part.start);
        tell(trial);
        next.outcome.released = flat(part) || part.pops ? std::max(0.0, own - ledger.increment)
                                                        : freed(trial) * (ledger.dissipated - at_.ledger.dissipated);
        ledger.work = at_.ledger.work + own;
        ledger.released = at_.ledger.released + next.outcome.released;
    }
    next.jump_within = {};
    part.pops = part.pops || next.outcome.released > 0.0;
    events_.add(part, at_, next);
    sum_.add_part(ledger, at_.ledger);
    outcome_.released += next.outcome.released;
    outcome_.mixity_held += next.outcome.mixity_held;
    converged_ = converged_ && result.converged;
    searched_ += result.searched;
    parts_.push_back({next.time, trial.stride});
    // After a jump, or an unloading, the path turns off.
    if (part.advance.area > 0.0 && !flat(part) && !(trial.stride < 1.0)) next.jump_before = at_.response.jump;
    at_ = std::move(next);
    --at_.step;  // the parts of a step share its number
}

// The whole step: the last state, with the sums and the effort of all parts.
ControlledStep LoadPath::close() {
    events_.end();
    ++at_.step;
    history_.substeps = static_cast<std::int64_t>(parts_.size());
    ControlledStep out{{std::move(at_), converged_, std::move(searched_)}, std::move(events_.jumps), std::move(parts_)};
    for (JumpEvent& jump : out.jumps) jump.step = out.result.state.step;
    State& state = out.result.state;
    state.ledger.take_parts(sum_);
    outcome_.damage_change = state.outcome.damage_change;
    outcome_.jumps = static_cast<std::int64_t>(out.jumps.size());
    outcome_.pops = events_.pops;
    outcome_.popped = events_.popped;
    if (!popping_) growth_.pop_time = 0.0;
    growth_.way = 1;
    state.effort = effort_;
    state.outcome = outcome_;
    state.history = history_;
    state.growth = growth_;
    return out;
}

}  // namespace

bool follows_load(const Options& options) { return options.step_control == "load"; }

ControlledStep followed_step(Stepper& stepper, const PairGraph& graph, const State& before, double time,
                             const Options& options, double base) {
    return LoadPath(stepper, graph, before, time, options, base).run();
}

}  // namespace delam
