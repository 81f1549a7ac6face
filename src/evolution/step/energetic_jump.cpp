// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/step/energetic_jump.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>

#include "base/numbers.hpp"
#include "evolution/minimise/proportional_loads.hpp"
#include "evolution/step/growth_events.hpp"

namespace delam {

namespace {

// A ring is broken if its pairs have no more than this part of what they had. (Measured by
// delam run with solution = energetic on a film that comes off by cooling: half of it gives the same jump. With twice
// of it, whatever is loaded would count as broken.)
constexpr double broken = 0.5;

// Returns how many rings, from the first on, hold this of all their pairs.
std::size_t leading(const GrowthProfile& profile, const std::function<bool(std::size_t)>& holds) {
    std::size_t n = 0;
    while (n < profile.ring.size() &&
           std::ranges::all_of(profile.ring[n], [&](std::int64_t p) { return holds(index(p)); }))
        ++n;
    return n;
}

// Returns the size of an interface as far as it adhered at first.
double whole_of(const PairLaws& pairs, const PairGraph& graph, std::span<const double> initial,
                std::int64_t interface) {
    double whole = 0.0;
    for (std::size_t p = 0; p < initial.size(); ++p)
        if (graph.interface_of(p) == interface && pairs.law[p] != nullptr && initial[p] > 0.0) whole += pairs.weight[p];
    return whole;
}

struct Run {
    std::size_t from = 0, to = 0;  // rings
    double square = 1.0;           // of the load of its first edge
    double area = 0.0;
};

// Returns the longest flat run of edges.
Run longest_run(const std::vector<GrowthProfile::Edge>& edges, std::span<const double> area, double whole) {
    Run longest;
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t j = i;
        GrowthPart part;
        part.advance.whole = whole;
        const auto goes_on = [&](std::size_t last) {
            part.advance.area = area[edges[last].to] - area[edges[i].from];
            part.rise = 0.5 * std::log(edges[last].square / edges[i].square);
            return flat(part);
        };
        while (j + 1 < edges.size() && goes_on(j + 1)) ++j;
        const double extent = area[edges[j].to] - area[edges[i].from];
        if (extent > longest.area) longest = {edges[i].from, edges[j].to, edges[i].square, extent};
        i = j + 1;
    }
    return longest;
}

// True if most of what a step has debonded lies where the growth of a front was sampled.
bool tells_most(const PairLaws& pairs, std::span<const std::uint8_t> told, const State& before, const State& after) {
    double all = 0.0, there = 0.0;
    for (std::size_t p = 0; p < told.size(); ++p) {
        if (pairs.law[p] == nullptr) continue;
        const double own = pairs.weight[p] * (before.adhesion[p] - after.adhesion[p]);
        all += own;
        if (told[p] != 0) there += own;
    }
    return there > 0.5 * all;
}

}  // namespace

std::optional<JumpWithin> energetic_jump(const PairLaws& pairs, const PairGraph& graph, std::span<const double> initial,
                                         std::span<const GrowthProfile> profiles, const State& before,
                                         const State& after) {
    const bool unloaded = max_abs(before.theta) == 0.0;
    const std::optional<double> begin = unloaded ? 0.0 : load_ratio(before.theta, after.theta);
    if (begin && *begin > 1.0) return std::nullopt;
    JumpWithin found;
    found.known = JumpWithin::told_by_search;
    std::vector<std::uint8_t> told(initial.size(), 0);
    for (const GrowthProfile& profile : profiles) {
        const std::size_t reached =
            leading(profile, [&](std::size_t p) { return after.adhesion[p] <= broken * before.adhesion[p]; });
        const auto softened = [&](const State& state) {
            return leading(profile, [&](std::size_t p) { return initial[p] - state.adhesion[p] > debonded_below; });
        };
        const std::size_t zone = softened(before), ahead = softened(after);
        for (std::size_t n = 0; n < std::max(reached, ahead) && n < profile.ring.size(); ++n)
            for (const std::int64_t p : profile.ring[n]) told[index(p)] = 1;
        if (static_cast<double>(reached) <= static_cast<double>(zone) + pairs_of_jump) continue;
        std::vector<double> area(1, 0.0);
        for (const std::vector<std::int64_t>& ring : profile.ring) {
            double own = 0.0;
            for (const std::int64_t p : ring) own += pairs.weight[index(p)] * before.adhesion[index(p)];
            area.push_back(area.back() + own);
        }
        const Run run =
            longest_run(profile.edges(zone, reached), area, whole_of(pairs, graph, initial, profile.interface));
        if (static_cast<double>(run.to - run.from) <= pairs_of_jump || !(run.area > found.debonded)) continue;
        found.debonded = run.area;
        found.interface = profile.interface;
        found.load = begin ? std::clamp(std::sqrt(run.square), *begin, 1.0) : 1.0;
    }
    if (!(found.debonded > 0.0)) return tells_most(pairs, told, before, after) ? std::optional(found) : std::nullopt;
    found.released = after.outcome.released;
    found.conjugate_before = before.response.conjugate;
    found.conjugate_after = after.response.conjugate;
    if (!begin) return found;
    for (double& q : found.conjugate_before) q *= *begin > 0.0 ? found.load / *begin : 1.0;
    for (double& q : found.conjugate_after) q *= found.load;
    return found;
}

}  // namespace delam
