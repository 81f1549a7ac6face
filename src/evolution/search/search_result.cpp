// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/search/search_result.hpp"

#include <algorithm>

#include "base/numbers.hpp"

namespace delam {

namespace {

constexpr double same = 1e-3;  // spread of toughnesses, relative

}  // namespace

bool same_toughness(const PairLaws& pairs, const Candidate& candidate, std::span<const double> from) {
    double least = infinite, most = 0.0;
    for (std::size_t p = 0; p < from.size(); ++p) {
        if (pairs.law[p] == nullptr || !(candidate.adhesion[p] <= 0.0) || !(from[p] > 0.0)) continue;
        const double total = pairs.toughness(p, candidate.mixity[p]).total;
        least = std::min(least, total);
        most = std::max(most, total);
    }
    return most <= (1.0 + same) * least;
}

bool within_zone(std::span<const double> candidate, std::span<const double> from) {
    std::int64_t debonded = 0, softening = 0;
    for (std::size_t p = 0; p < from.size(); ++p) {
        debonded += candidate[p] <= 0.0 && from[p] > 0.0 ? 1 : 0;
        softening += from[p] > 0.0 && from[p] < 1.0 ? 1 : 0;
    }
    return debonded <= softening;
}

double LeftOut::bound(const PathCosts& path) const {
    const auto cost_of = [&](std::size_t pair, double own) {
        return pair < path.broken.size() && path.broken[pair] != 0 ? path.cost[pair] : own;
    };
    double cost = begun, lowest = infinite;
    for (std::size_t p = 0; p < least.size(); ++p)
        if (least[p] > 0.0) cost += cost_of(p, least[p]);
    std::size_t n = 0;
    for (const Place& place : places) {
        for (; n < place.rings; ++n)
            for (std::size_t i = 0; i < ring[n].size(); ++i) cost += cost_of(index(ring[n][i]), ring_least[n][i]);
        lowest = std::min(lowest, place.energy + cost);
    }
    return lowest;
}

double SearchResult::bound(const PathCosts& path) const {
    double least = infinite;
    for (const LeftOut& own : left_out) least = std::min(least, own.bound(path));
    return least;
}

}  // namespace delam
