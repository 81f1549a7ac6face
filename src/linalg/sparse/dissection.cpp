// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/sparse/dissection.hpp"

#include <limits>
#include <utility>

#include "base/cancel_scope.hpp"
#include "base/metis.hpp"
#include "base/numbers.hpp"
#include "linalg/sparse/equal_rows.hpp"

namespace delam {

namespace {

constexpr std::size_t few_vertices = 200;  // METIS itself orders smaller graphs by minimum degree

// False: too many edges for METIS' integers.
bool graph_between(const SparseMatrix& m, std::int64_t leading, const EqualRows& groups, Graph& graph) {
    constexpr auto most = index(std::numeric_limits<idx_t>::max());
    std::vector<std::int64_t> seen(groups.count(), -1);
    for (std::size_t v = 0; v < groups.count(); ++v) {
        poll_cancel("order");
        const std::size_t r = index(groups.member[index(groups.start[v])]);
        seen[v] = static_cast<std::int64_t>(v);
        for (std::int64_t e = m.start[r]; e < m.start[r + 1]; ++e) {
            if (m.column[index(e)] >= leading) continue;
            const std::int64_t w = groups.of[index(m.column[index(e)])];
            if (std::exchange(seen[index(w)], static_cast<std::int64_t>(v)) == static_cast<std::int64_t>(v)) continue;
            graph.neighbour.push_back(static_cast<idx_t>(w));
        }
        if (graph.neighbour.size() > most) return false;
        graph.start.push_back(static_cast<idx_t>(graph.neighbour.size()));
        graph.weight.push_back(static_cast<idx_t>(groups.start[v + 1] - groups.start[v]));
    }
    return true;
}

}  // namespace

std::vector<std::int64_t> dissection_order(const SparseMatrix& matrix, std::int64_t leading) {
    if (leading > std::numeric_limits<idx_t>::max()) return {};
    const EqualRows groups = equal_rows(matrix, leading, leading);
    Graph graph;
    if (groups.count() < few_vertices || !graph_between(matrix, leading, groups, graph)) return {};
    std::vector<std::int64_t> order;
    order.reserve(index(leading));
    for (const idx_t v : dissect_with_metis(graph))
        for (std::int64_t i = groups.start[index(v)]; i < groups.start[index(v) + 1]; ++i)
            order.push_back(groups.member[index(i)]);
    return order;
}

}  // namespace delam
