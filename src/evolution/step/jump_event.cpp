// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/step/jump_event.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "base/numbers.hpp"
#include "evolution/minimise/proportional_loads.hpp"

namespace delam {

namespace {

// These numbers say what is told as a jump; the first also below which share of the energy a balance may stay open with
// large rotations. (Measured by verify/bench/constants.py with verify/cases/search/energetic.py: no energy changes; of
// 23 jumps, half of `released_share` tells three more and twice three fewer, half of `load_drop` the same ones and
// twice one fewer, half and twice of `single_row` the same ones.)
constexpr double released_share = 1e-3;  // of the larger of energy and work
constexpr double load_drop = 0.02;       // of the load
constexpr double single_row = 1.5;       // a front that moves on by one row of pairs does not jump
// The trapezoid of reactions leaves this part of what a step dissipates open where the reactions fall abruptly. An
// end-notched beam whose support ends leaves 0.24 in the step of its jump, cantilevers that open steadily 0.04 at most.
// (`delam run --set solver.kinematics=corotational`, before steps were also halved for it where the load does not fall:
// half changes no iteration of that beam, dcb-elastica, peel, blister and another beam in 15 to 60 steps; twice loses
// the jump of the first. Since then a heated film that comes off by 17 mm in its first step and leaves 0.85 open is
// halved; peel takes 1.05 and dcb-elastica 1.11 times the iterations.)
constexpr double open_share = 0.1;
// So does a load that falls below this share in one step; whether its parts hold a jump is judged anew. (A heated film
// that comes off by 20 mm in one of 24 steps falls to 0.045, and leaves 0.048 open: half and twice
// tell the same jump; twice, every fall, takes 1.7 times the iterations of examples/peel.)
constexpr double collapse = 0.5;
// Where less than this share of the energy is dissipated, what stays open is compared with this share of the energy.
// (`delam run --set solver.kinematics=corotational`: half and twice dissipate the same to 5e-4 in single-leg bending in
// 10 steps, with 1.03 and 0.95 times the alternations, open 0.33 and 0.48 instead of 0.39 % of it; dcb-elastica takes
// 1.29 and 1.0, peel 1.0 and 0.95 times the alternations, with the same digits of what is dissipated.)
constexpr double little_dissipated = 0.1;

// Longest advance that is no jump: of a step that moves each front of an interface by one row of pairs. Its fronts are
// the pairs next to a debonded region that the step has damaged: one for each front in the plane, a row in space.
double regular_advance(const PairLaws& pairs, const PairGraph& graph, const State& before, const State& after,
                       std::int64_t interface) {
    double row = 0.0, sum = 0.0, count = 0.0;
    for (std::size_t p = 0; p < before.adhesion.size(); ++p) {
        if (graph.interface_of(p) != interface || pairs.law[p] == nullptr) continue;
        sum += pairs.weight[p];
        count += 1.0;
        if (!(before.adhesion[p] - after.adhesion[p] > debonded_below)) continue;
        const auto neighbours = graph.neighbours(p);
        if (std::any_of(neighbours.begin(), neighbours.end(), [&](std::int64_t q) {
                return pairs.law[index(q)] != nullptr && before.adhesion[index(q)] <= debonded_below;
            }))
            row += 1.0;
    }
    return count > 0.0 ? single_row * sum / count * std::max(row, 1.0) : 0.0;
}

// sum w (zeta before - zeta after) of each interface.
std::vector<double> advances(const PairLaws& pairs, const PairGraph& graph, const State& before, const State& after) {
    std::vector<double> found;
    for (std::size_t p = 0; p < before.adhesion.size(); ++p) {
        const std::size_t interface = index(graph.interface_of(p));
        if (found.size() <= interface) found.resize(interface + 1, 0.0);
        if (pairs.law[p] != nullptr) found[interface] += pairs.weight[p] * (before.adhesion[p] - after.adhesion[p]);
    }
    return found;
}

// Force along the loads.
double load(const State& state) {
    double along = 0.0, size = 0.0;
    for (std::size_t p = 0; p < state.theta.size(); ++p) {
        along += state.theta[p] * state.response.conjugate[p];
        size = std::hypot(size, state.theta[p]);
    }
    return size > 0.0 ? along / size : 0.0;
}

}  // namespace

JumpEvent describe_jump(const PairLaws& pairs, const PairGraph& graph, const State& before, const State& after) {
    const Ledger &a = before.ledger, &b = after.ledger;
    JumpEvent jump{after.step,
                   before.time,
                   after.time,
                   b.energy() - a.energy(),
                   b.dissipated - a.dissipated,
                   b.released - a.released,
                   0.0,
                   0,
                   -1,
                   -1,
                   before.response.conjugate,
                   after.response.conjugate};
    if (after.jump_within.known != 0 && after.jump_within.debonded > 0.0) {
        const double begin = load_ratio(before.theta, after.theta).value_or(0.0);
        const double instant = begin < 1.0 ? (after.jump_within.load - begin) / (1.0 - begin) : 1.0;
        jump.before = jump.time = before.time + instant * (after.time - before.time);
        jump.released = after.jump_within.released;
        jump.conjugate_before = after.jump_within.conjugate_before;
        jump.conjugate_after = after.jump_within.conjugate_after;
    }
    const std::vector<double> changed = advances(pairs, graph, before, after);
    jump.debonded = std::accumulate(changed.begin(), changed.end(), 0.0);
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

namespace {

// True if a front of this interface moves on so far that it may have jumped.
bool far(const PairLaws& pairs, const PairGraph& graph, const State& before, const State& after, std::int64_t interface,
         double advance) {
    return advance > 0.0 && advance > regular_advance(pairs, graph, before, after, interface);
}

// Holds what a step dissipates, and what its work leaves open.
struct Account {
    double dissipated, open;
};
Account account(const State& before, const State& after) {
    const Ledger &a = before.ledger, &b = after.ledger;
    const double dissipated = b.dissipated - a.dissipated;
    return {dissipated, b.work - a.work - (b.energy() - a.energy()) - dissipated - (b.released - a.released)};
}

bool loses_load(const State& before, const State& after) {
    return std::abs(load(after)) < (1.0 - load_drop) * std::abs(load(before));
}

}  // namespace

bool moves_far(const PairLaws& pairs, const PairGraph& graph, const State& before, const State& after) {
    const std::vector<double> advance = advances(pairs, graph, before, after);
    for (std::size_t i = 0; i < advance.size(); ++i)
        if (far(pairs, graph, before, after, static_cast<std::int64_t>(i), advance[i])) return true;
    return false;
}

bool jumps(const PairLaws& pairs, const PairGraph& graph, const State& before, const State& after) {
    const auto worth = [&](double released) { return released > released_share * after.ledger.scale(); };
    if (after.jump_within.known == JumpWithin::told_by_search) return after.jump_within.debonded > 0.0;
    if (const JumpWithin& jump = after.jump_within; jump.known != 0)
        return (jump.drop > load_drop || worth(jump.released)) &&
               far(pairs, graph, before, after, jump.interface, jump.debonded);
    if (!(after.outcome.released > 0.0)) return false;
    if (!loses_load(before, after) && !worth(after.outcome.released)) return false;
    return moves_far(pairs, graph, before, after);
}

bool leaves_open(const State& before, const State& after) {
    const auto [dissipated, open] = account(before, after);
    return dissipated > 0.0 &&
           std::abs(open) > std::max(open_share * dissipated, released_share * after.ledger.scale());
}

bool leaves_open(const State& before, const State& after, double accuracy) {
    const auto [dissipated, open] = account(before, after);
    const double least = little_dissipated * after.ledger.scale();
    return dissipated > 0.0 && std::abs(open) > accuracy * std::max(dissipated, least) &&
           std::abs(after.ledger.defect()) > accuracy * std::max(after.ledger.dissipated, least);
}

bool hides_jump(const PairLaws& pairs, const PairGraph& graph, const State& before, const State& after) {
    const bool collapses = std::abs(load(after)) < collapse * std::abs(load(before));
    return (leaves_open(before, after) || collapses) && moves_far(pairs, graph, before, after);
}

}  // namespace delam
