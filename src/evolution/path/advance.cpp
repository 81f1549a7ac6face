// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/path/advance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/numbers.hpp"

namespace delam {

namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();
// Share of its toughness from which on a pair lies behind the front, as in inner_path.cpp. (Measured by
// verify/bench/constants.py with verify/cases/load_path/steps.py: 0.96 and 0.99 change no digit.)
constexpr double spent = 0.98;
// Smaller changes of this share are what a minimisation leaves open (damage_tolerance is 1e-5). (Measured by
// verify/bench/constants.py with verify/cases/load_path/steps.py: half and twice change the dissipated energy of mixed
// bending by 1e-4.)
constexpr double damaged = 1e-3;
// Part of the largest loss from which on a pair counts as one of the first ones, where no front tells them.
constexpr double of_the_most = 0.5;
// Part of the largest advance from which on another one, of pairs that do not touch, counts beside it. (Measured by
// delam run on DCBs with two notches, in the plane and in space, examples/enf, mmb, laminate-dcb and dcb-alfano with
// 100 and 200 cells: half and twice change no digit.)
constexpr double beside_the_most = 0.1;

// g/Gc, [pairs]; 1 where nothing adheres.
std::vector<double> spent_shares(const PairLaws& pairs, const State& state) {
    std::vector<double> share(state.adhesion.size(), 0.0);
    for (std::size_t p = 0; p < share.size(); ++p) {
        const double adhesion = state.adhesion[p];
        if (pairs.law[p] == nullptr || !(adhesion < 1.0)) continue;
        if (!(adhesion > 0.0)) {
            share[p] = 1.0;
            continue;
        }
        const Toughness t = pairs.toughness(p, state.mixity[p]);
        share[p] = pairs.law[p]->dissipated(t, adhesion) / t.total;
    }
    return share;
}

// Pairs next to each other that were damaged.
struct Patch {
    std::size_t interface = 0;
    double area = 0.0, front = 0.0;
    bool met = true;
};

// before, after: g/Gc, [pairs]
Patch patch_of(const PairLaws& pairs, const PairGraph& graph, const std::vector<std::int64_t>& group,
               std::span<const double> before, std::span<const double> after) {
    Patch patch;
    patch.interface = index(graph.interface_of(index(group.front())));
    for (const std::int64_t pair : group) {
        const std::size_t p = index(pair);
        const auto neighbours = graph.neighbours(p);
        const auto any_is = [&](bool is_spent, std::span<const double> share) {
            return std::any_of(neighbours.begin(), neighbours.end(),
                               [&](std::int64_t q) { return (share[index(q)] >= spent) == is_spent; });
        };
        patch.area += pairs.weight[p] * (after[p] - before[p]);
        if (before[p] < spent && any_is(true, before)) patch.front += pairs.weight[p];
        patch.met = patch.met && after[p] >= spent && !any_is(false, after);
    }
    return patch;
}

}  // namespace

Advance advance_between(const PairLaws& pairs, const PairGraph& graph, std::span<const double> initial,
                        const State& before, const State& after) {
    const std::vector<double> from = spent_shares(pairs, before), to = spent_shares(pairs, after);
    std::vector<Advance> of;
    std::vector<double> most_lost, largest;
    std::vector<std::uint8_t> lost(from.size(), 0);
    for (std::size_t p = 0; p < from.size(); ++p) {
        const std::size_t i = index(graph.interface_of(p));
        if (of.size() <= i) {
            of.resize(i + 1);
            most_lost.resize(i + 1, 0.0);
            largest.resize(i + 1, 0.0);
        }
        if (pairs.law[p] == nullptr || !(initial[p] > 0.0)) continue;
        of[i].whole += pairs.weight[p];
        if (!(after.adhesion[p] < before.adhesion[p])) continue;
        of[i].area += pairs.weight[p] * std::max(0.0, to[p] - from[p]);
        if (to[p] - from[p] < damaged) continue;
        of[i].zone += pairs.weight[p];
        lost[p] = 1;
        most_lost[i] = std::max(most_lost[i], to[p] - from[p]);
    }
    std::vector<Patch> patches;
    for (const std::vector<std::int64_t>& group : components(graph, lost)) {
        const Patch& patch = patches.emplace_back(patch_of(pairs, graph, group, from, to));
        if (patch.area > largest[patch.interface]) of[patch.interface].met = patch.met;
        largest[patch.interface] = std::max(largest[patch.interface], patch.area);
    }
    for (const Patch& patch : patches)
        if (patch.area > beside_the_most * largest[patch.interface]) of[patch.interface].row += patch.front;
    for (Advance& own : of) own.fronts = own.row > 0.0;
    for (std::size_t p = 0; p < from.size(); ++p) {
        const std::size_t i = index(graph.interface_of(p));
        if (lost[p] != 0 && !of[i].fronts && to[p] - from[p] > of_the_most * most_lost[i]) of[i].row += pairs.weight[p];
    }
    Advance most;
    for (const Advance& own : of)
        if (own.area > most.area) most = own;
    return most;
}

double load_margin(const PairLaws& pairs, const State& state) {
    double least = no_limit;
    for (std::size_t p = 0; p < state.adhesion.size(); ++p) {
        if (pairs.law[p] == nullptr || !(state.adhesion[p] > 0.0)) continue;
        const Driving y = driving_energy(pairs, p, state.response.jump);
        if (!(y.total() > 0.0)) continue;
        const Mixity mixity = pairs.mixed(p) ? y.mixity() : state.mixity[p];
        const double threshold = pairs.law[p]->driving(pairs.toughness(p, mixity), state.adhesion[p]);
        least = std::min(least, std::sqrt(threshold / y.total()));
    }
    return std::max(1.0, least);
}

}  // namespace delam
