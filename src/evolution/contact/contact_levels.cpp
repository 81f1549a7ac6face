// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/contact/contact_levels.hpp"

#include <algorithm>

#include "base/numbers.hpp"

namespace delam {

namespace {

// The coarsest level keeps about this many pairs of an interface.
constexpr std::size_t coarsest = 16;

}  // namespace

std::vector<std::uint8_t> contact_levels(std::span<const InterfaceGeometry> interfaces) {
    std::vector<std::uint8_t> level;
    for (const InterfaceGeometry& interface : interfaces) {
        const std::size_t pairs = interface.node_a.size(), corners = index(interface.nodes_per_face);
        std::vector<std::vector<std::size_t>> neighbours(pairs);
        for (std::size_t f = 0; f + corners <= interface.face.size(); f += corners)
            for (std::size_t a = 0; a < corners; ++a)
                for (std::size_t b = 0; b < corners; ++b)
                    if (a != b) neighbours[index(interface.face[f + a])].push_back(index(interface.face[f + b]));
        std::uint8_t top = 0;
        while ((pairs >> (top + 1)) >= coarsest) ++top;

        // Level after level, chooses each pair that no chosen one reaches within 2^l - 1 faces.
        std::vector<std::uint8_t> own(pairs, 0), chosen(pairs, 0), mark(pairs, 0);
        std::vector<std::size_t> seen;
        for (std::uint8_t l = top; l > 0; --l) {
            const std::size_t radius = (std::size_t{1} << l) - 1;
            std::vector<std::uint8_t> reached(pairs, 0);
            const auto reach = [&](std::size_t from) {
                std::vector<std::size_t> ring{from};
                reached[from] = 1;
                seen.assign(1, from);
                mark[from] = 1;
                for (std::size_t step = 0; step < radius && !ring.empty(); ++step) {
                    std::vector<std::size_t> next;
                    for (const std::size_t i : ring)
                        for (const std::size_t j : neighbours[i])
                            if (mark[j] == 0) {
                                mark[j] = reached[j] = 1;
                                seen.push_back(j);
                                next.push_back(j);
                            }
                    ring = std::move(next);
                }
                for (const std::size_t i : seen) mark[i] = 0;
            };
            for (std::size_t p = 0; p < pairs; ++p)
                if (chosen[p] != 0) reach(p);
            for (std::size_t p = 0; p < pairs; ++p) {
                if (reached[p] != 0) continue;
                chosen[p] = 1;
                own[p] = l;
                reach(p);
            }
        }
        level.insert(level.end(), own.begin(), own.end());
    }
    return level;
}

}  // namespace delam
