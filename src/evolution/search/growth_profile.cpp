// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/search/growth_profile.hpp"

#include <algorithm>
#include <cmath>

namespace delam {

// Andrew's monotone chain.
std::vector<GrowthProfile::Edge> GrowthProfile::edges(std::size_t first, std::size_t last) const {
    std::vector<Sample> hull;
    const auto above_chord = [](const Sample& a, const Sample& b, const Sample& c) {
        return (b.energy - a.energy) * (c.cost - a.cost) >= (c.energy - a.energy) * (b.cost - a.cost);
    };
    for (const Sample& s : samples) {
        if (s.rings < first || s.rings > last || !std::isfinite(s.energy)) continue;
        while (hull.size() > 1 && above_chord(hull[hull.size() - 2], hull.back(), s)) hull.pop_back();
        hull.push_back(s);
    }
    std::vector<Edge> found;
    for (std::size_t i = 1; i < hull.size(); ++i) {
        const double gain = hull[i - 1].energy - hull[i].energy;
        if (!(gain > 0.0)) break;  // the rest is never reached
        found.push_back({hull[i - 1].rings, hull[i].rings, (hull[i].cost - hull[i - 1].cost) / gain});
    }
    return found;
}

bool GrowthProfile::sampled_within(const Edge& edge) const {
    return std::ranges::any_of(samples, [&](const Sample& s) { return s.rings > edge.from && s.rings < edge.to; });
}

}  // namespace delam
