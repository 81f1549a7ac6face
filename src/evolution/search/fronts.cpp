// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/search/fronts.hpp"

#include <algorithm>
#include <utility>

#include "base/numbers.hpp"

namespace delam {

namespace {

constexpr double worth_mentioning = 1e-9;  // of the toughness

}  // namespace

PairGraph::PairGraph(std::span<const InterfaceGeometry> interfaces) {
    std::vector<std::pair<std::int64_t, std::int64_t>> links;
    std::int64_t first = 0;
    for (std::size_t i = 0; i < interfaces.size(); ++i) {
        const InterfaceGeometry& geometry = interfaces[i];
        const auto corners = index(geometry.nodes_per_face);
        for (std::size_t f = 0; f + corners <= geometry.face.size(); f += corners)
            for (std::size_t a = 0; a < corners; ++a)
                for (std::size_t b = 0; b < corners; ++b)
                    if (geometry.face[f + a] != geometry.face[f + b])
                        links.emplace_back(first + geometry.face[f + a], first + geometry.face[f + b]);
        first_.push_back(first);
        first += geometry.pair_count();
        interface_.resize(index(first), static_cast<std::int64_t>(i));
    }
    std::sort(links.begin(), links.end());
    links.erase(std::unique(links.begin(), links.end()), links.end());
    start_.assign(index(first) + 1, 0);
    for (const auto& [p, q] : links) {
        ++start_[index(p) + 1];
        neighbour_.push_back(q);
    }
    for (std::size_t p = 0; p + 1 < start_.size(); ++p) start_[p + 1] += start_[p];
}

std::vector<std::vector<std::int64_t>> components(const PairGraph& graph, const std::vector<std::uint8_t>& set) {
    std::vector<std::vector<std::int64_t>> found;
    std::vector<std::uint8_t> seen(set.size(), 0);
    for (std::size_t p = 0; p < set.size(); ++p) {
        if (set[p] == 0 || seen[p] != 0) continue;
        std::vector<std::int64_t> part{static_cast<std::int64_t>(p)};
        seen[p] = 1;
        for (std::size_t at = 0; at < part.size(); ++at)
            for (const std::int64_t q : graph.neighbours(index(part[at])))
                if (set[index(q)] != 0 && seen[index(q)] == 0) {
                    seen[index(q)] = 1;
                    part.push_back(q);
                }
        std::sort(part.begin(), part.end());
        found.push_back(std::move(part));
    }
    return found;
}

std::vector<std::uint8_t> adhering_pairs(const PairLaws& pairs, std::span<const double> adhesion,
                                         std::span<const Toughness> toughness) {
    std::vector<std::uint8_t> adhering(adhesion.size(), 0);
    for (std::size_t p = 0; p < adhering.size(); ++p) {
        if (pairs.law[p] == nullptr || !(adhesion[p] > 0.0)) continue;
        const double left = toughness[p].total - pairs.law[p]->dissipated(toughness[p], adhesion[p]);
        adhering[p] = left > worth_mentioning * toughness[p].total ? 1 : 0;
    }
    return adhering;
}

std::vector<Front> find_fronts(const PairGraph& graph, const PairLaws& pairs, std::span<const std::uint8_t> adhering,
                               std::span<const Toughness> toughness, std::span<const double> jump, std::size_t seeds) {
    const std::size_t count = adhering.size();
    std::vector<std::uint8_t> front(count, 0);
    for (std::size_t p = 0; p < count; ++p)
        for (const std::int64_t q : graph.neighbours(p))
            if (adhering[p] != 0 && pairs.law[index(q)] != nullptr && adhering[index(q)] == 0) front[p] = 1;
    std::vector<Front> found;
    for (std::vector<std::int64_t>& part : components(graph, front)) {
        const std::int64_t interface = graph.interface_of(index(part.front()));
        found.push_back({interface, false, std::move(part)});
    }

    std::vector<double> load(count, -1.0);  // driving energy over onset
    for (std::size_t p = 0; p < count; ++p)
        if (adhering[p] != 0) load[p] = driving_energy(pairs, p, jump).total() / toughness[p].onset;
    std::vector<std::pair<double, std::int64_t>> peaks;
    std::vector<std::int64_t> ends;
    for (std::size_t p = 0; p < count; ++p) {
        if (adhering[p] == 0 || front[p] != 0) continue;
        bool peak = load[p] > 0.0, beside_front = false;
        for (const std::int64_t q : graph.neighbours(p)) {
            peak =
                peak && (load[p] > load[index(q)] || (load[p] == load[index(q)] && static_cast<std::int64_t>(p) < q));
            beside_front = beside_front || front[index(q)] != 0;
        }
        if (pairs.dimension == 2 && graph.neighbours(p).size() <= 1)
            ends.push_back(static_cast<std::int64_t>(p));
        else if (peak && !beside_front)
            peaks.emplace_back(load[p], static_cast<std::int64_t>(p));
    }
    std::stable_sort(peaks.begin(), peaks.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    for (const std::int64_t p : ends) found.push_back({graph.interface_of(index(p)), true, {p}});
    std::vector<std::size_t> taken;
    for (const auto& [value, p] : peaks) {
        const std::int64_t interface = graph.interface_of(index(p));
        if (taken.size() <= index(interface)) taken.resize(index(interface) + 1, 0);
        if (taken[index(interface)]++ < seeds) found.push_back({interface, true, {p}});
    }
    return found;
}

std::vector<std::vector<std::int64_t>> rings(const PairGraph& graph, std::span<const std::uint8_t> adhering,
                                             const Front& front) {
    std::vector<std::vector<std::int64_t>> found{front.pairs};
    std::vector<std::uint8_t> seen(adhering.size(), 0);
    for (const std::int64_t p : front.pairs) seen[index(p)] = 1;
    while (true) {
        std::vector<std::int64_t> next;
        for (const std::int64_t p : found.back())
            for (const std::int64_t q : graph.neighbours(index(p))) {
                if (seen[index(q)] != 0 || adhering[index(q)] == 0) continue;
                seen[index(q)] = 1;
                next.push_back(q);
            }
        if (next.empty()) return found;
        std::sort(next.begin(), next.end());
        found.push_back(std::move(next));
    }
}

}  // namespace delam
