// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/step/load_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "base/numbers.hpp"
#include "evolution/path/advance.hpp"
#include "evolution/step/bounds.hpp"
#include "evolution/step/growth_events.hpp"
#include "scene/advice/process_zone.hpp"

namespace delam {

namespace {

// Pairs on a front that a part of mixed mode dissipates, or one where pairs pop. (Measured by verify/bench/constants.py
// with verify/cases/load_path/steps.py, of these and those below: half and twice change the energy that mixed bending
// dissipates by 2e-5 and 3e-3 (`pairs_of_part`), 6e-4 and 4e-3 (`allowance`), and half by 1.2e-3 (`telling_part`), and
// no digit else; its answer is right to 5e-3. With twice of `pairs_of_part` and --all the ledger is open by 0.51 %.)
constexpr double pairs_of_part = 0.5, popping_pairs = 1.0;
constexpr double same_rate = 3.0;      // times the rate of the part before: the growth goes on as it did
constexpr double allowance = 1.2;      // times what a part should dissipate
constexpr double telling_part = 0.25;  // pairs on a front: less of an advance does not tell how a front grows
constexpr double set_free = 0.05;      // of what a part dissipates: it would release more than by its own error
constexpr int most_refused = 40;       // parts in a row; then one is kept, however far it goes

// The instants of a part.
struct Plan {
    double start;     // from which on pairs may be damaged
    double reach;     // end of the part
    double shortest;  // that changes anything beyond the tolerance of the minimisation
};

// Returns how much larger the load of the state after is, as ln M with E = M^2 / 2 at the damage before: the factor of
// the loads where they grow in proportion. Infinity: the energy does not tell it.
double load_rise(const State& before, const State& after) {
    if (const std::optional<double> a = load_ratio(before.theta, after.theta)) return -std::log(*a);
    const double from = before.ledger.energy(), to = from + after.ledger.upper;
    return from * to > 0.0 ? 0.5 * std::abs(std::log(to / from)) : std::numeric_limits<double>::infinity();
}

class LoadPath {
public:
    LoadPath(Stepper& stepper, const PairGraph& graph, const State& before, double end, const Options& options)
        : stepper_(stepper),
          options_(options),
          end_(end),
          at_(before),
          graph_(graph),
          events_(stepper.pairs(), graph),
          growth_(before.growth),
          popping_(before.growth.pop_time > 0.0),
          popped_(popping_) {
        history_.revised_from = before.step + 1;
        least_rise_ = std::max(smallest_share(stepper.pairs(), graph, stepper.initial_adhesion()) * one_pair_rise,
                               10.0 * options.damage_tolerance);
    }

    ControlledStep run() {
        while (at_.time < end_) advance();
        return close();
    }

private:
    static constexpr double one_pair_rise = 0.01;  // a third of what makes the advance of one pair flat

    Plan plan() const;
    void advance();
    double wanted(const Advance& advance, bool one_mode) const;
    void learn(const GrowthPart& part, const Plan& plan, bool one_mode, bool pops);
    void accept(Stepper::Result result, const GrowthPart& part);
    double work(const State& next, double start) const;
    ControlledStep close();

    Stepper& stepper_;
    const Options& options_;
    double end_;
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
        plan.reach = at_.time + growth_.pop_time * (popped_ ? 1.0 : 0.3);
    else if (growth_.part_time > 0.0)
        plan.reach = plan.start + growth_.part_time;
    plan.reach = std::min(end_, std::max(plan.reach, plan.start + plan.shortest));
    return plan;
}

double LoadPath::wanted(const Advance& advance, bool one_mode) const {
    const double pairs = one_mode ? pairs_of_jump : popping_ ? popping_pairs : pairs_of_part;
    return std::max(pairs * advance.row, options_.path_step * advance.zone);
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

// Makes parts from the present state, shorter and shorter, until one may be kept.
void LoadPath::advance() {
    Plan plan = this->plan();
    bool along_path = popping_;  // the part is followed in parts at its own load
    for (int refused = 0;;) {
        plan.reach = std::max(plan.reach, std::nextafter(at_.time, end_));
        Stepper::Result result = stepper_.step(at_, plan.reach, {}, along_path ? options_.path_step : 1.0);
        effort_.add(result.state.effort);
        const double own = std::max(plan.reach - plan.start, 0.0);
        GrowthPart part{advance_between(stepper_.pairs(), graph_, stepper_.initial_adhesion(), at_, result.state),
                        load_rise(at_, result.state) * own / (plan.reach - at_.time), std::min(plan.start, plan.reach),
                        false};
        if (!(part.advance.zone > 0.0)) {
            part.advance = {};
            if (own > 0.0) growth_.part_time = 4.0 * own;
            return accept(std::move(result), part);
        }
        const bool one_mode = stepper_.one_mode(at_, result.state);
        const double limit = wanted(part.advance, one_mode);
        const bool goes_on =
            one_mode && growth_.rate > 0.0 && part.advance.area <= same_rate * growth_.rate * part.rise;
        if (flat(part) || goes_on || part.advance.area <= allowance * limit || refused > most_refused) {
            const bool telling = part.advance.area > telling_part * part.advance.row;
            if (telling) resolved_ = part.advance.zone > resolving_pairs * part.advance.row;
            const double dissipated = result.state.ledger.dissipated - at_.ledger.dissipated;
            const bool releases =
                work(result.state, plan.start) - result.state.ledger.increment > set_free * dissipated;
            const bool pops =
                telling && single_pairs(part.advance) && (!resolved_ || flat(part) || (!one_mode && releases));
            if (!along_path && !one_mode && (flat(part) || pops)) {
                along_path = true;  // its path decides what it dissipates
                continue;
            }
            popping_ = popping_ || pops;
            part.pops = popping_;
            learn(part, plan, one_mode, telling && popping_);
            return accept(std::move(result), part);
        }
        ++refused;
        ++history_.refused_steps;
        growth_.pop_time *= 0.5;
        plan.reach = plan.start + own * std::clamp(0.8 * limit / part.advance.area, 0.05, 0.5);
    }
}

// Plans the next part from this one.
void LoadPath::learn(const GrowthPart& part, const Plan& plan, bool one_mode, bool pops) {
    const double own = plan.reach - plan.start;
    const bool goes_on = one_mode && growth_.rate > 0.0 && part.advance.area <= same_rate * growth_.rate * part.rise;
    growth_.part_time = own * std::clamp(wanted(part.advance, one_mode) / part.advance.area, goes_on ? 4.0 : 0.2, 4.0);
    if (part.rise > 0.0 && std::isfinite(part.rise) && !flat(part)) growth_.rate = part.advance.area / part.rise;
    popped_ = pops;
    if (popping_ && !pops) growth_.pop_time *= 1.6;
    if (!pops) return;
    growth_.pop_time = std::isfinite(last_pop_) ? plan.reach - last_pop_ : growth_.pop_time;
    last_pop_ = plan.reach;
}

// Records the part. The work of a flat one is that at the damage before.
void LoadPath::accept(Stepper::Result result, const GrowthPart& part) {
    State& next = result.state;
    Ledger& ledger = next.ledger;
    // Where nothing is damaged, the work may have been integrated over changes of the contact.
    const bool known = !(part.advance.area > 0.0) || (part.pops && !flat(part) && next.jump_within.known != 0);
    if (!known) {
        const bool moves_first = flat(part) && load_ratio(at_.theta, next.theta);
        const double own = moves_first ? ledger.upper : work(next, part.start);
        next.outcome.released = flat(part) || part.pops ? std::max(0.0, own - ledger.increment) : 0.0;
        ledger.work = at_.ledger.work + own;
        ledger.released = at_.ledger.released + next.outcome.released;
    }
    next.jump_within = {};
    events_.add(part, at_, next);
    sum_.lower += ledger.lower;
    sum_.increment += ledger.increment;
    sum_.upper += ledger.upper;
    sum_.increment_lower += ledger.increment_lower;
    sum_.mixity_error = std::max(sum_.mixity_error, ledger.mixity_error);
    outcome_.released += next.outcome.released;
    outcome_.mixity_held += next.outcome.mixity_held;
    converged_ = converged_ && result.converged;
    searched_ += result.searched;
    ++history_.substeps;
    at_ = std::move(next);
    --at_.step;  // the parts of a step share its number
}

// The whole step: the last state, with the sums and the effort of all parts.
ControlledStep LoadPath::close() {
    events_.end();
    ++at_.step;
    ControlledStep out{{std::move(at_), converged_, std::move(searched_)}, std::move(events_.jumps)};
    for (JumpEvent& jump : out.jumps) jump.step = out.result.state.step;
    State& state = out.result.state;
    state.ledger.lower = sum_.lower;
    state.ledger.increment = sum_.increment;
    state.ledger.upper = sum_.upper;
    state.ledger.increment_lower = sum_.increment_lower;
    state.ledger.mixity_error = sum_.mixity_error;
    outcome_.damage_change = state.outcome.damage_change;
    outcome_.jumps = static_cast<std::int64_t>(out.jumps.size());
    outcome_.pops = events_.pops;
    outcome_.popped = events_.popped;
    if (!popping_) growth_.pop_time = 0.0;
    state.effort = effort_;
    state.outcome = outcome_;
    state.history = history_;
    state.growth = growth_;
    return out;
}

}  // namespace

bool follows_load(const Options& options) { return options.step_control == "load"; }

ControlledStep followed_step(Stepper& stepper, const PairGraph& graph, const State& before, double time,
                             const Options& options) {
    return LoadPath(stepper, graph, before, time, options).run();
}

}  // namespace delam
