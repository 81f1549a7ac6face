// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/step/load_path.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>
#include <vector>

#include "base/numbers.hpp"

namespace delam {

namespace {

constexpr double eps = 0.03;           // relative rise of the load over which a whole interface may debond in a jump
constexpr double jumping_pairs = 2.5;  // of each front: a smaller event is that of single pairs
constexpr double share = 0.5;          // of the pairs on a front that a part of mixed mode dissipates
constexpr double steady = 3.0;         // times the rate of the part before: about the same rate
constexpr double spent = 0.98;         // share of its toughness from which on a pair lies behind the front
constexpr double damaged = 1e-3;       // share that tells damage from rounding
constexpr double over = 1.2;           // times what a part should dissipate

// What a part has dissipated, of the interface where that is most.
struct Advance {
    double area = 0.0;   // sum w dg/Gc, L or L2
    double row = 0.0;    // of the pairs on its fronts
    double zone = 0.0;   // of all pairs that it damages
    double whole = 0.0;  // of the interface, as far as it adhered at first
};

std::vector<double> shares(const PairLaws& pairs, const State& state) {
    std::vector<double> of(state.adhesion.size(), 0.0);
    for (std::size_t p = 0; p < of.size(); ++p) {
        if (pairs.law[p] == nullptr) continue;
        const Toughness t = pairs.toughness(p, state.mixity[p]);
        of[p] = state.adhesion[p] > 0.0 ? pairs.law[p]->dissipated(t, state.adhesion[p]) / t.total : 1.0;
    }
    return of;
}

Advance advance_of(const PairLaws& pairs, const PairGraph& graph, std::span<const double> initial, const State& before,
                   const State& after) {
    const std::vector<double> from = shares(pairs, before), to = shares(pairs, after);
    std::vector<Advance> of;
    std::vector<double> smallest;
    for (std::size_t p = 0; p < from.size(); ++p) {
        const std::size_t i = index(graph.interface_of(p));
        if (of.size() <= i) of.resize(i + 1), smallest.resize(i + 1, std::numeric_limits<double>::infinity());
        if (pairs.law[p] == nullptr || !(initial[p] > 0.0)) continue;
        of[i].whole += pairs.weight[p];
        if (!(after.adhesion[p] < before.adhesion[p])) continue;
        const double change = std::max(0.0, to[p] - from[p]);
        of[i].area += pairs.weight[p] * change;
        if (change < damaged) continue;
        of[i].zone += pairs.weight[p];
        smallest[i] = std::min(smallest[i], pairs.weight[p]);
        const auto neighbours = graph.neighbours(p);
        if (from[p] < spent && std::any_of(neighbours.begin(), neighbours.end(),
                                           [&](std::int64_t q) { return from[index(q)] >= spent; }))
            of[i].row += pairs.weight[p];
    }
    Advance most;
    for (std::size_t i = 0; i < of.size(); ++i)
        if (of[i].area > most.area) {
            most = of[i];
            if (!(most.row > 0.0)) most.row = std::min(smallest[i], most.zone);
        }
    return most;
}

// ln of the load after over that before, both at the damage before: E = M^2 / 2.
double rise(const State& before, const State& after, double upper) {
    if (const std::optional<double> a = load_ratio(before.theta, after.theta)) return -std::log(*a);
    const double from = before.ledger.energy(), to = from + upper;
    return from * to > 0.0 ? 0.5 * std::abs(std::log(to / from)) : std::numeric_limits<double>::infinity();
}

class Follower {
public:
    Follower(Stepper& stepper, const PairGraph& graph, const State& before, double end, const Options& options)
        : stepper_(stepper), graph_(graph), options_(options), end_(end), begin_(before.time), at_(before), rate_(before.growth) {
        history_.revised_from = before.step + 1;
    }

    ControlledStep run() {
        while (at_.time < end_) part();
        return close();
    }

private:
    struct Part {
        double rise = 0.0;  // of ln M, from the first damage on
        double area = 0.0, row = 0.0, whole = 0.0;
        bool flat = false;
    };

    // Factor on the load at which the first pair meets its threshold; 1: some do now.
    double margin() const {
        double least = std::numeric_limits<double>::infinity();
        const PairLaws& pairs = stepper_.pairs();
        for (std::size_t p = 0; p < at_.adhesion.size(); ++p) {
            if (pairs.law[p] == nullptr || !(at_.adhesion[p] > 0.0)) continue;
            const Driving y = driving_energy(pairs, p, at_.response.jump);
            if (!(y.total() > 0.0)) continue;
            const double b = pairs.mixed(p) ? (y.total() > 0.0 ? y.tangential / y.total() : 0.0) : at_.mixity[p];
            const double need = pairs.law[p]->driving(pairs.toughness(p, b), at_.adhesion[p]);
            least = std::min(least, std::sqrt(need / y.total()));
        }
        return std::max(1.0, least);
    }

    void part() {
        const double length = end_ - at_.time;
        double start = at_.time;  // from where on pairs may be damaged
        double reach = end_;
        const std::optional<double> a =
            at_.loaded != 0 ? load_ratio(at_.theta, stepper_.factors(end_)) : std::nullopt;
        const double least_rise = std::max(0.3 * eps * least_share(), 10.0 * options_.damage_tolerance);
        if (a && *a < 1.0) {
            // In proportion, the instant of the first damage is known.
            const double factor = margin(), per_rise = *a / (1.0 - *a) * length;  // time over d(M/M_0)
            const double onset = factor > 1.0 + 0.1 * least_rise ? (factor - 1.0) * per_rise : 0.0;
            const double first = least_rise * per_rise;
            if (onset >= length) {
                start = end_;
            } else {
                start = at_.time + onset;
                reach = std::min(end_, start + (onset > 0.0 ? first : next_length_ > 0.0 ? std::max(next_length_, first) : length));
            }
        } else if (next_length_ > 0.0) {
            reach = std::min(end_, at_.time + next_length_);
        }
        while (true) {
            if (!(reach > at_.time)) reach = std::nextafter(at_.time, end_);
            Stepper::Result result = stepper_.step(at_, reach);
            effort_.add(result.state.effort);
            const Advance advance = advance_of(stepper_.pairs(), graph_, stepper_.initial_adhesion(), at_, result.state);
            const double own = reach - start;
            const double rose = rise(at_, result.state, result.state.ledger.upper) * std::clamp(own / (reach - at_.time), 0.0, 1.0);
            if (!(advance.zone > 0.0)) {
                if (own > 0.0) next_length_ = 4.0 * own;
                accept(std::move(result), {}, start);
                return;
            }
            const bool one_mode = stepper_.one_mode(at_, result.state);
            const bool flat = rose <= eps * advance.area / advance.whole;
            const double target = one_mode ? jumping_pairs * advance.row : share * advance.row;
            const double wanted = std::max(target, options_.path_step * advance.zone);
            const bool same_rate = one_mode && rate_ > 0.0 && advance.area <= steady * rate_ * rose;
            if (flat || same_rate || advance.area <= over * wanted) {
                next_length_ = own * std::clamp(wanted / advance.area, 0.2, 4.0);
                if (same_rate) next_length_ = std::max(next_length_, 4.0 * own);
                if (rose > 0.0 && std::isfinite(rose) && !flat) rate_ = advance.area / rose;
                accept(std::move(result), {rose, advance.area, advance.row, advance.whole, flat}, start);
                return;
            }
            ++refused_;
            reach = start + own * std::clamp(0.8 * wanted / advance.area, 0.05, 0.5);
        }
    }

    // Smallest weight of a pair over the area of its interface: the least advance that counts.
    double least_share() {
        if (least_share_ > 0.0) return least_share_;
        const PairLaws& pairs = stepper_.pairs();
        std::vector<double> whole, smallest;
        for (std::size_t p = 0; p < pairs.law.size(); ++p) {
            const std::size_t i = index(graph_.interface_of(p));
            if (whole.size() <= i) whole.resize(i + 1, 0.0), smallest.resize(i + 1, std::numeric_limits<double>::infinity());
            if (pairs.law[p] == nullptr || !(stepper_.initial_adhesion()[p] > 0.0)) continue;
            whole[i] += pairs.weight[p];
            smallest[i] = std::min(smallest[i], pairs.weight[p]);
        }
        least_share_ = 1.0;
        for (std::size_t i = 0; i < whole.size(); ++i)
            if (whole[i] > 0.0) least_share_ = std::min(least_share_, smallest[i] / whole[i]);
        return least_share_;
    }

    void accept(Stepper::Result result, Part part, double start) {
        State& next = result.state;
        Ledger& ledger = next.ledger;
        const Ledger& before = at_.ledger;
        double trapezoid = 0.0;
        for (std::size_t p = 0; p < next.theta.size(); ++p)
            trapezoid += 0.5 * (next.theta[p] - at_.theta[p]) * (next.response.conjugate[p] + at_.response.conjugate[p]);
        const bool moved_first = part.flat || (start > at_.time && part.area > 0.0);
        const double work = moved_first && load_ratio(at_.theta, next.theta) ? ledger.upper : trapezoid;
        next.outcome.released = part.flat ? std::max(0.0, work - ledger.increment) : 0.0;
        ledger.work = before.work + work;
        ledger.released = before.released + next.outcome.released;
        next.jump_within = {};
        watch(part, next);
        sum_.lower += ledger.lower;
        sum_.increment += ledger.increment;
        sum_.upper += ledger.upper;
        sum_.increment_lower += ledger.increment_lower;
        sum_.mixity_error = std::max(sum_.mixity_error, ledger.mixity_error);
        outcome_.released += next.outcome.released;
        outcome_.mixity_held += next.outcome.mixity_held;
        converged_ = converged_ && result.converged;
        searched_ += result.searched;
        ++parts_;
        if (std::getenv("DELAM_TRACE"))
            std::fprintf(stderr, "part %.9g..%.9g rise %.3g area %.4g row %.3g whole %.3g flat %d work %.5g incr %.5g am %ld rate %.4g\n", at_.time, next.time,
                         part.rise, part.area, part.row, part.whole, part.flat, work, ledger.increment, (long)next.effort.am_iterations, rate_);
        at_ = std::move(next);
        --at_.step;
    }

    // Extends or ends the event of which the part may belong.
    void watch(const Part& part, State& next) {
        const double area = event_.area + part.area, lift = event_.rise + part.rise;
        const bool belongs = in_event_ && part.area > 0.0 && lift <= eps * area / std::max(part.whole, event_.whole);
        if (in_event_ && !belongs) end_event();
        if (!in_event_ && part.flat) {
            in_event_ = true;
            event_ = {};
            event_begin_ = at_;
        }
        if (!in_event_) return;
        event_.area += part.area;
        event_.rise += part.rise;
        event_.row = std::max(event_.row, part.row);
        event_.whole = std::max(event_.whole, part.whole);
        event_end_ = next;
    }

    void end_event() {
        in_event_ = false;
        const bool jump = event_.area > std::min(jumping_pairs * event_.row, 0.5 * event_.whole);
        if (!jump) {
            ++pops_;
            popped_ += event_end_.ledger.released - event_begin_.ledger.released;
            return;
        }
        jumps_.push_back(describe_jump(stepper_.pairs(), graph_, event_begin_, event_end_));
        jumps_.back().step = at_.step + 1;
    }

    ControlledStep close() {
        if (in_event_) end_event();
        ++at_.step;
        ControlledStep out{{std::move(at_), converged_, std::move(searched_)}, std::move(jumps_)};
        State& state = out.result.state;
        state.ledger.lower = sum_.lower;
        state.ledger.increment = sum_.increment;
        state.ledger.upper = sum_.upper;
        state.ledger.increment_lower = sum_.increment_lower;
        state.ledger.mixity_error = sum_.mixity_error;
        outcome_.damage_change = state.outcome.damage_change;
        outcome_.jumps = static_cast<std::int64_t>(out.jumps.size());
        history_.substeps = parts_;
        history_.refused_steps = refused_;
        state.effort = effort_;
        state.outcome = outcome_;
        state.history = history_;
        state.growth = rate_;
        return out;
    }

    Stepper& stepper_;
    const PairGraph& graph_;
    const Options& options_;
    double end_, begin_;
    State at_, event_begin_, event_end_;
    double rate_ = 0.0, next_length_ = 0.0, least_share_ = 0.0;
    Part event_;
    bool in_event_ = false, converged_ = true;
    std::vector<JumpEvent> jumps_;
    std::string searched_;
    Effort effort_;
    StepOutcome outcome_;
    StepHistory history_;
    Ledger sum_;
    std::int64_t parts_ = 0, refused_ = 0, pops_ = 0;
    double popped_ = 0.0;
};

}  // namespace

bool follows_load(const Options& options) {
    return options.solution == "local" && options.mixity_rule == "converged" && options.minimisation != "alternate" &&
           options.path_step < 1.0 && !controls_steps(options) && options.backtracking != "on" &&
           std::getenv("DELAM_WHOLE") == nullptr;
}

ControlledStep followed_step(Stepper& stepper, const PairGraph& graph, const State& before, double time,
                             const Options& options) {
    return Follower(stepper, graph, before, time, options).run();
}

}  // namespace delam
