// SPDX-License-Identifier: BSD-3-Clause
// METIS (G. Karypis): cuts graphs and orders matrices. Only these two files include it.
#pragma once

#include <metis.h>

#include <cstddef>
#include <span>
#include <vector>

#include "base/numbers.hpp"

namespace delam {

// Compressed adjacency of vertices numbered from 0, without loops; every edge stands at both its ends.
struct Graph {
    std::vector<idx_t> start{0};
    std::vector<idx_t> neighbour;
    std::vector<idx_t> weight;  // of the vertices; empty: all alike

    std::size_t size() const { return start.size() - 1; }
    std::span<const idx_t> around(std::size_t i) const {
        const auto first = index(start[i]), end = index(start[i + 1]);
        return std::span(neighbour).subspan(first, end - first);
    }
};

// Both: the same graph gives the same result, whatever the host did with rand() or METIS before. They cannot be
// interrupted, and one call runs at a time. METIS does not change the graph, although it takes it as variable.

// Part of each vertex of a connected graph, 0 .. parts-1, with short borders. Parts may be empty or disconnected.
std::vector<idx_t> cut_with_metis(Graph& graph, idx_t parts);
// Vertices in the order of nested dissection.
std::vector<idx_t> dissect_with_metis(Graph& graph);

}  // namespace delam
