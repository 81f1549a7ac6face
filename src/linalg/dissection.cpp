// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/dissection.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/cancel_scope.hpp"
#include "base/metis.hpp"
#include "base/numbers.hpp"

namespace delam {

namespace {

constexpr std::size_t few_vertices = 200;  // METIS itself orders smaller graphs by minimum degree

std::uint64_t scrambled(std::uint64_t x) {  // the finaliser of SplitMix64 (S. Vigna)
    x += 0x9E3779B97F4A7C15u;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
}

// Groups of variables with equal rows, recognised by a checksum of their columns, in the order of their first members.
// Two different rows with the same checksum would make a poorer order, not a wrong one.
struct Groups {
    std::vector<std::int64_t> of;      // group of each variable
    std::vector<std::int64_t> member;  // variables, group by group
    std::vector<std::int64_t> start{0};

    std::size_t count() const { return start.size() - 1; }
};

Groups groups_of_equal_rows(const SparseMatrix& m, std::int64_t leading) {
    std::vector<std::pair<std::uint64_t, std::int64_t>> rows;  // checksum, variable
    rows.reserve(index(leading));
    for (std::int64_t r = 0; r < leading; ++r) {
        poll_cancel("order");
        std::uint64_t sum = 0;
        for (std::int64_t e = m.start[index(r)]; e < m.start[index(r) + 1]; ++e)
            if (m.column[index(e)] < leading) sum += scrambled(static_cast<std::uint64_t>(m.column[index(e)]));
        rows.emplace_back(sum, r);
    }
    std::sort(rows.begin(), rows.end());
    std::vector<std::int64_t> first(index(leading));  // first variable with the same row
    for (std::size_t i = 0, begin = 0; i < rows.size(); ++i) {
        if (rows[i].first != rows[begin].first) begin = i;
        first[index(rows[i].second)] = rows[begin].second;
    }
    Groups groups;
    groups.of.resize(index(leading));
    std::vector<std::int64_t> size;
    for (std::int64_t r = 0; r < leading; ++r) {
        if (first[index(r)] == r) {
            groups.of[index(r)] = static_cast<std::int64_t>(size.size());
            size.push_back(0);
        } else {
            groups.of[index(r)] = groups.of[index(first[index(r)])];
        }
        ++size[index(groups.of[index(r)])];
    }
    for (const std::int64_t s : size) groups.start.push_back(groups.start.back() + s);
    std::vector<std::int64_t> next(groups.start.begin(), groups.start.end() - 1);
    groups.member.resize(index(leading));
    for (std::int64_t r = 0; r < leading; ++r) groups.member[index(next[index(groups.of[index(r)])]++)] = r;
    return groups;
}

// False: too many edges for METIS' integers.
bool graph_between(const SparseMatrix& m, std::int64_t leading, const Groups& groups, Graph& graph) {
    constexpr auto most = static_cast<std::size_t>(std::numeric_limits<idx_t>::max());
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
    const Groups groups = groups_of_equal_rows(matrix, leading);
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
