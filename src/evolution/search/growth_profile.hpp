// SPDX-License-Identifier: BSD-3-Clause
// The energies along the growth of one front, as a search has sampled them.
//
// Under loads in proportion, E of an adhesion is M^2 e, with M the size of the load. The states of least M^2 e + D at
// growing M then lie on the lower convex hull of the samples in the plane of D and e. Each of its edges is passed at
// one load,
//
//   M^2 = (D_2 - D_1) / (e_1 - e_2),
//
// at which the front moves from one of its ends to the other: where growth is stable, from ring to ring at growing
// loads, and where it is not, over all rings of the edge at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace delam {

struct GrowthProfile {
    struct Sample {
        std::size_t rings;  // that are debonded
        double energy;      // E at the load of the step, F L
        double cost;        // D and the gradient energy, F L
    };
    // An edge of the hull.
    struct Edge {
        std::size_t from, to;  // rings
        double square;         // of the load at which it is passed, over the square of the load of the step
    };
    std::int64_t interface;
    std::vector<std::vector<std::int64_t>> ring;  // pairs
    std::vector<Sample> samples;                  // by rings

    // Returns the edges of the hull of the samples with at least `first` and at most `last` rings, ascending.
    std::vector<Edge> edges(std::size_t first, std::size_t last) const;
    // True if a sample lies within an edge.
    bool sampled_within(const Edge& edge) const;
};

}  // namespace delam
