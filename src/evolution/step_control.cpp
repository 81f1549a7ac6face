// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/step_control.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

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

JumpEvent describe(const PairLaws& pairs, const PairGraph& graph, const State& before, const State& after) {
    const Ledger &a = before.ledger, &b = after.ledger;
    JumpEvent jump{after.step,
                   before.time,
                   after.time,
                   b.energy() - a.energy(),
                   b.dissipated - a.dissipated,
                   b.upper - b.increment,
                   0.0,
                   0,
                   -1,
                   -1};
    std::vector<double> changed;
    for (std::size_t p = 0; p < before.adhesion.size(); ++p) {
        const auto interface = static_cast<std::size_t>(graph.interface_of(p));
        if (changed.size() <= interface) changed.resize(interface + 1, 0.0);
        const double c = pairs.weight[p] * (before.adhesion[p] - after.adhesion[p]);
        changed[interface] += c;
        jump.debonded += c;
    }
    jump.interface = std::max_element(changed.begin(), changed.end()) - changed.begin();
    for (std::size_t p = 0; p < before.adhesion.size(); ++p) {
        if (graph.interface_of(p) != jump.interface || before.adhesion[p] - after.adhesion[p] <= debonded_below)
            continue;
        const std::int64_t local = static_cast<std::int64_t>(p) - graph.first_pair(jump.interface);
        if (jump.first_pair < 0) jump.first_pair = local;
        jump.last_pair = local;
    }
    return jump;
}

// An instant to be reached, and its state once computed.
struct Goal {
    double time;
    std::unique_ptr<Stepper::Result> reached;  // null: not computed
    double change = 0.0;
    int smooth = 0;
    bool sharp = false;  // nearly all of the change in an interval about twice as long
};

}  // namespace

bool controls_steps(const Options& options) {
    return options.jump_tolerance > 0.0 || options.step_control == "adaptive" || options.mixity_step_tolerance > 0.0;
}

ControlledStep controlled_step(Stepper& stepper, const PairGraph& graph, const State& before, Stepper::Result whole,
                               const Options& options) {
    const double asked = whole.state.time - before.time;
    const bool locate = options.jump_tolerance > 0.0;
    // While nothing is damaged the work is exact, however wide the band.
    const auto too_long = [&](const Stepper::Result& r, double change) {
        const Ledger& l = r.state.ledger;
        const double scale = std::max(std::abs(l.energy()), std::abs(l.work));
        return (options.step_control == "adaptive" &&
                (!r.converged || (change > 0.0 && l.upper - l.lower > options.step_tolerance * scale))) ||
               (options.mixity_step_tolerance > 0.0 && r.state.ledger.mixity_error > options.mixity_step_tolerance);
    };
    ControlledStep out;
    State at = before;
    at.step = whole.state.step - 1;
    const Counts first = whole.state.counts;
    Counts effort;
    Ledger sum;  // of the parts
    bool converged = true;
    std::int64_t parts = 0, refused = 0;

    std::vector<Goal> goals;
    const double end = whole.state.time;
    goals.push_back({end, std::make_unique<Stepper::Result>(std::move(whole)), 0.0, 0});
    effort.add(first);
    goals.back().change = change_in_pairs(stepper.pairs(), at, goals.back().reached->state);
    const auto accept = [&](Goal goal) {
        State& next = goal.reached->state;
        sum.lower += next.ledger.lower;
        sum.increment += next.ledger.increment;
        sum.upper += next.ledger.upper;
        sum.increment_lower += next.ledger.increment_lower;
        effort.search_gap = std::max(effort.search_gap, next.counts.search_gap);
        effort.search_margin =
            parts == 0 ? next.counts.search_margin : std::min(effort.search_margin, next.counts.search_margin);
        sum.mixity_error = std::max(sum.mixity_error, next.ledger.mixity_error);
        converged = converged && goal.reached->converged;
        ++parts;
        at = std::move(next);
        --at.step;  // the parts of a step share its number
        // What was computed from the start of this part is invalid from its end.
        for (Goal& other : goals)
            if (other.reached) {
                other.reached.reset();
                ++refused;
            }
    };
    while (!goals.empty()) {
        Goal& goal = goals.back();
        if (!goal.reached) {
            goal.reached = std::make_unique<Stepper::Result>(stepper.step(at, goal.time));
            effort.add(goal.reached->state.counts);
            const double longer = goal.change;  // to the same end, from an earlier start
            goal.change = change_in_pairs(stepper.pairs(), at, goal.reached->state);
            goal.sharp = goal.change > sharp_share * longer && longer > 0.0;
            if (goals.size() > 1) {
                Goal& parent = goals[goals.size() - 2];
                const double share = parent.change > 0.0 ? goal.change / parent.change : 0.0;
                goal.sharp = goal.sharp || (parent.reached && share > sharp_share);
                goal.smooth = parent.reached && share > 0.25 && share < 0.75 ? parent.smooth + 1 : 0;
                if (goal.smooth >= smooth_levels && !too_long(*parent.reached, parent.change)) {
                    // The change over the parent's interval is continuous, so its end is reached in one part.
                    goals.pop_back();
                    Goal done = std::move(parent);
                    goals.pop_back();
                    ++refused;
                    accept(std::move(done));
                    continue;
                }
            }
        }
        const double length = goal.time - at.time;
        const bool jumps = locate && goal.change >= options.jump_size;
        const bool halve = (jumps && (length > options.jump_tolerance * asked ||
                                      (!goal.sharp && length > options.smallest_step * asked))) ||
                           (too_long(*goal.reached, goal.change) && length > options.smallest_step * asked);
        const double middle = at.time + 0.5 * length;
        if (halve && middle > at.time && middle < goal.time) {
            goals.push_back({middle, nullptr, 0.0, 0});
            continue;
        }
        if (jumps) out.jumps.push_back(describe(stepper.pairs(), graph, at, goal.reached->state));
        if (jumps) out.jumps.back().step = before.step + 1;
        Goal done = std::move(goal);
        goals.pop_back();
        accept(std::move(done));
    }
    ++at.step;
    out.result = {std::move(at), converged};
    State& state = out.result.state;
    state.ledger.lower = sum.lower;
    state.ledger.increment = sum.increment;
    state.ledger.upper = sum.upper;
    state.ledger.increment_lower = sum.increment_lower;
    effort.damage_change = state.counts.damage_change;
    state.ledger.mixity_error = sum.mixity_error;
    effort.backtracks = first.backtracks;
    effort.revisions = first.revisions;
    effort.revised_from = first.revised_from;
    effort.substeps = parts;
    effort.refused_steps = refused;
    effort.jumps = static_cast<std::int64_t>(out.jumps.size());
    for (const JumpEvent& jump : out.jumps) effort.released += jump.released;
    state.counts = effort;
    return out;
}

}  // namespace delam
