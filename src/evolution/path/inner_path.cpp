// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/path/inner_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/numbers.hpp"
#include "evolution/increment/path_dissipation.hpp"
#include "scene/advice/expected_parts.hpp"

namespace delam {

namespace {

// Half and twice of these numbers were measured by verify/bench/constants.py with verify/bench/analyses.py: those of
// `softening` move the dissipated energy by 0.1 %, and of the others not at all. (Parts repeated until their recorded
// error was below `accuracy` took 1.26 times the alternations in examples/mmb and left what parts of other sizes
// change: the states differ, not the integrals.)
constexpr double nearly_loaded_share = 0.5;  // driving energy over onset, from which the mode of a pair counts
constexpr double softening = 0.02;           // share dissipated, and left, of a pair in the process zone
constexpr double same_mode = 1e-3;           // spread of onset and toughness, relative, that is no change of mode

Dissipation at_mixities(const PairLaws& pairs, const PairMixities& mixity, std::span<const double> from,
                        std::span<const double> to) {
    Dissipation sum{dissipation(pairs, mixity, from, to), dissipation_linear(pairs, mixity, from, to), 0.0,
                    std::vector<double>(to.size(), 0.0)};
    for (std::size_t p = 0; p < to.size(); ++p) {
        if (pairs.law[p] == nullptr || to[p] == from[p]) continue;
        const Toughness t = pairs.toughness(p, mixity[p]);
        const Law& law = *pairs.law[p];
        sum.of_pair[p] = pairs.weight[p] * (law.dissipated(t, to[p]) - law.dissipated(t, from[p]));
    }
    return sum;
}

}  // namespace

bool InnerPath::one_mode(const State& at, const PairMixities& mixity, const State* before) const {
    double least[2] = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    double most[2] = {0.0, 0.0};
    bool any = false;
    const auto add = [&](const Toughness& t) {
        least[0] = std::min(least[0], t.onset), most[0] = std::max(most[0], t.onset);
        least[1] = std::min(least[1], t.total), most[1] = std::max(most[1], t.total);
    };
    const Law* law = nullptr;
    double least_onset = 0.0;  // of this law
    for (std::size_t p = 0; p < at.adhesion.size(); ++p) {
        if (!pairs_.mixed(p)) continue;
        if (law != pairs_.law[p]) {
            law = pairs_.law[p];
            least_onset = law->onset_bound();
        }
        const Driving y = driving_energy(pairs_, p, at.response.jump);
        const bool damaged = before != nullptr && at.adhesion[p] < before->adhesion[p];
        const bool partly = at.adhesion[p] > 0.0 && at.adhesion[p] < 1.0;
        const auto nearly = [&](double onset) {
            return at.adhesion[p] > 0.0 && y.total() > nearly_loaded_share * onset;
        };
        if (!damaged && !partly && !nearly(least_onset)) continue;
        const Toughness t = pairs_.toughness(p, mixity[p]);
        if (!damaged && !partly && !nearly(t.onset)) continue;
        any = true;
        add(t);
        if (damaged && tells_mixity(*pairs_.law[p], y, 0.0)) add(pairs_.toughness(p, y.mixity()));
    }
    return !any || (most[0] <= (1.0 + same_mode) * least[0] && most[1] <= (1.0 + same_mode) * least[1]);
}

PathPoint path_point(const PairLaws& pairs, const PairGraph& graph, const State& state, double dissipated) {
    PathPoint point;
    point.energy = state.response.stored_bulk + state.response.load_potential +
                   stored_energy(pairs, state.adhesion, state.response.jump);
    point.gradient = gradient_energy(pairs, state.adhesion);
    point.dissipated = dissipated;
    for (std::size_t p = 0; p < state.adhesion.size(); ++p) {
        const std::size_t interface = index(graph.interface_of(p));
        if (point.debonded.size() <= interface) point.debonded.resize(interface + 1, 0.0);
        if (pairs.law[p] != nullptr) point.debonded[interface] += pairs.weight[p] * (1.0 - state.adhesion[p]);
    }
    point.conjugate = state.response.conjugate;
    return point;
}

void InnerPath::record(const State& at, const State& next) {
    const auto dim = index(pairs_.dimension);
    const auto local = [dim](const std::vector<double>& jump, std::size_t pair) {
        return jump.empty() ? std::span<const double>() : std::span<const double>(jump).subspan(pair * dim, dim);
    };
    for (std::size_t p = 0; p < at.adhesion.size(); ++p) {
        if (pairs_.law[p] == nullptr || next.adhesion[p] == at.adhesion[p]) continue;
        const PathEnergy e = path_energy(pairs_, p,
                                         {local(last_, p), local(at.response.jump, p), local(next.response.jump, p),
                                          at.adhesion[p], next.adhesion[p]},
                                         next.mixity[p]);
        dissipated_.recorded += pairs_.weight[p] * e.dissipated;
        if (!dissipated_.of_pair.empty()) dissipated_.of_pair[p] += pairs_.weight[p] * e.dissipated;
        dissipated_.linear += pairs_.weight[p] * e.linear;
        dissipated_.error += pairs_.weight[p] * e.error;
    }
}

// A path is long where the process zone has few pairs, because each of them softens while the others wait. There the
// mesh decides about the growth, and the share is so large that a front needs no more than two parts for a pair.
double InnerPath::bound(const State& at, const PairMixities& mixity) const {
    std::vector<std::uint8_t> softening_pair(at.adhesion.size(), 0), broken(at.adhesion.size(), 0);
    std::int64_t interfaces = 0;
    for (std::size_t p = 0; p < at.adhesion.size(); ++p) {
        interfaces = std::max(interfaces, graph_.interface_of(p) + 1);
        if (pairs_.law[p] == nullptr || !(at.adhesion[p] < 1.0)) continue;
        if (!(at.adhesion[p] > 0.0)) {
            broken[p] = 1;
            continue;
        }
        const Toughness t = pairs_.toughness(p, mixity[p]);
        const double share = pairs_.law[p]->dissipated(t, at.adhesion[p]) / t.total;
        broken[p] = share >= 1.0 - softening ? 1 : 0;
        softening_pair[p] = share > softening && broken[p] == 0 ? 1 : 0;
    }
    // The interface whose zone has the most pairs in the direction of its growth decides.
    std::vector<double> zone(index(interfaces), 0.0), front(index(interfaces), 0.0);
    for (std::size_t p = 0; p < at.adhesion.size(); ++p) {
        if (softening_pair[p] == 0) continue;
        zone[index(graph_.interface_of(p))] += 1.0;
        const auto neighbours = graph_.neighbours(p);
        if (std::any_of(neighbours.begin(), neighbours.end(), [&](std::int64_t q) { return broken[index(q)] != 0; }))
            front[index(graph_.interface_of(p))] += 1.0;
    }
    double longest = 1.0;
    for (std::size_t i = 0; i < zone.size(); ++i) longest = std::max(longest, zone[i] / std::max(front[i], 1.0));
    return std::clamp(pairs_of_part(stride_) / longest, stride_, 1.0);
}

bool InnerPath::part(const State& at, State& next, bool displaced) {
    const double stride = bound(at, next.mixity);
    const State start = next;
    const bool free = !bounded_ && !lags_ && one_mode(at, next.mixity, nullptr);
    std::unique_ptr<StepRule> own;
    const auto minimise = [&](double most) {
        const Effort effort = next.effort;
        next = start;
        next.effort = effort;
        own = make_(at, next.mixity, most);
        if (lags_) own->lag();
        bounded_ = most < 1.0;
        return minimise_(next, *own, displaced);
    };
    bool converged = minimise(lags_ ? stride_ : free ? 1.0 : stride);
    if (free && !one_mode(next, next.mixity, &at)) {
        double most = 0.0;
        for (std::size_t p = 0; p < next.adhesion.size(); ++p)
            if (pairs_.mixed(p) && next.adhesion[p] < at.adhesion[p])
                most = std::max(most, own->left(p, at.adhesion[p]) - own->left(p, next.adhesion[p]));
        if (most > stride) converged = minimise(stride);
    }
    // Where mixities and damage drive each other to and fro, mixities that lag let the damage come to rest, because
    // what has been damaged stays so.
    if (next.outcome.mixity_held > 0 && stride_ < 1.0) {
        lags_ = true;
        converged = minimise(stride_);
    }
    stopped_ = own->stopped(next.adhesion);
    if (!lags_) return converged;
    next.mixity = own->memory().own;
    stopped_ = stopped_ || (!own->follows() && next.adhesion != at.adhesion);
    return converged;
}

bool InnerPath::follow(State& next, const StepRule& step, const Dissipation* begun, const Watch& watch, bool displaced,
                       std::span<const double> last) {
    State at = step.before();
    at.theta = next.theta;
    at.time = next.time;
    dissipated_ = begun != nullptr ? *begun : at_mixities(pairs_, next.mixity, at.adhesion, next.adhesion);
    at.adhesion = next.adhesion;
    last_.assign(last.begin(), last.end());
    bounded_ = false;
    lags_ = false;
    points_.clear();
    started_elsewhere_ = next.adhesion != step.before().adhesion;
    std::int64_t held = 0;
    bool converged = part(at, next, displaced);
    while (true) {
        record(at, next);
        points_.push_back(path_point(pairs_, graph_, next, dissipated_.recorded));
        held = std::max(held, next.outcome.mixity_held);
        if ((watch && !watch(next, dissipated_)) || !stopped_) break;
        last_ = std::move(at.response.jump);
        at.adhesion = next.adhesion;
        at.response = next.response;
        at.closed = next.closed;
        converged = part(at, next, true) && converged;
    }
    next.outcome.mixity_held = held;
    return converged;
}

}  // namespace delam
