// SPDX-License-Identifier: BSD-3-Clause
//
// Cells are the vertices of a graph, shared faces its edges. METIS cuts it evenly with short borders. Parts that it
// leaves disconnected or empty are mended here, so that every part is non-empty and connected and their number is as
// requested.
#include "mesh/partition.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "base/metis.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "mesh/faces.hpp"

namespace delam {

namespace {

using Parts = std::vector<std::int32_t>;  // part of each vertex

// Connected pieces of each part: the piece of each vertex, numbered by their first vertices.
std::int32_t pieces(const Graph& graph, const Parts& part, std::vector<std::int32_t>& piece) {
    piece.assign(graph.size(), -1);
    std::int32_t count = 0;
    std::vector<std::size_t> open;
    for (std::size_t first = 0; first < graph.size(); ++first) {
        if (piece[first] >= 0) continue;
        open.assign(1, first);
        piece[first] = count;
        while (!open.empty()) {
            poll_cancel("partition");
            const std::size_t i = open.back();
            open.pop_back();
            for (const idx_t j : graph.around(i)) {
                if (piece[index(j)] >= 0 || part[index(j)] != part[i]) continue;
                piece[index(j)] = count;
                open.push_back(index(j));
            }
        }
        ++count;
    }
    return count;
}

// Each part keeps its largest piece; the others join the part with which they share most faces. Repeats until every
// part is connected; each round reduces the number of pieces, because a moved piece touches its new part.
void mend(const Graph& graph, Parts& part, std::int32_t parts) {
    std::vector<std::int32_t> piece;
    for (;;) {
        const std::int32_t count = pieces(graph, part, piece);
        std::vector<std::int64_t> size(index(count), 0);
        std::vector<std::int32_t> owner(index(count), 0);
        for (std::size_t i = 0; i < graph.size(); ++i) {
            ++size[index(piece[i])];
            owner[index(piece[i])] = part[i];
        }
        std::vector<std::int32_t> main(index(parts), -1);
        for (std::int32_t p = 0; p < count; ++p) {
            std::int32_t& m = main[index(owner[index(p)])];
            if (m < 0 || size[index(p)] > size[index(m)]) m = p;
        }
        std::int32_t loose = -1;  // the first small piece
        for (std::int32_t p = 0; p < count && loose < 0; ++p)
            if (main[index(owner[index(p)])] != p) loose = p;
        if (loose < 0) return;
        std::vector<std::int64_t> faces(index(parts), 0);
        for (std::size_t i = 0; i < graph.size(); ++i) {
            if (piece[i] != loose) continue;
            for (const idx_t j : graph.around(i))
                if (piece[index(j)] != loose) ++faces[index(part[index(j)])];
        }
        const auto target = static_cast<std::int32_t>(std::max_element(faces.begin(), faces.end()) - faces.begin());
        for (std::size_t i = 0; i < graph.size(); ++i)
            if (piece[i] == loose) part[i] = target;
    }
}

// Breadth-first tree of one part: its vertices in order, parents before children.
struct Tree {
    std::vector<std::size_t> order;
    std::vector<std::size_t> parent;  // by vertex
};
Tree breadth_first(const Graph& graph, const Parts& part, std::size_t root) {
    constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    Tree tree{{root}, std::vector<std::size_t>(graph.size(), none)};
    tree.parent[root] = root;
    for (std::size_t k = 0; k < tree.order.size(); ++k) {
        const std::size_t i = tree.order[k];
        for (const idx_t j : graph.around(i)) {
            if (part[index(j)] != part[root] || tree.parent[index(j)] != none) continue;
            tree.parent[index(j)] = i;
            tree.order.push_back(index(j));
        }
    }
    return tree;
}

// Cuts a connected part into two connected ones: the branch of a breadth-first tree closest to half of it becomes
// `added`. The tree starts from a vertex far out, so that its branches are long.
void halve(const Graph& graph, Parts& part, std::int32_t old, std::int32_t added) {
    const auto first = index(std::find(part.begin(), part.end(), old) - part.begin());
    const std::size_t far = breadth_first(graph, part, first).order.back();
    const Tree tree = breadth_first(graph, part, far);
    std::vector<std::size_t> weight(graph.size(), 1);  // of the branch below a vertex
    for (std::size_t k = tree.order.size() - 1; k > 0; --k) weight[tree.parent[tree.order[k]]] += weight[tree.order[k]];
    const auto off_half = [&](std::size_t i) {
        const std::size_t twice = 2 * weight[i];
        return twice > tree.order.size() ? twice - tree.order.size() : tree.order.size() - twice;
    };
    const std::size_t branch =
        *std::min_element(tree.order.begin() + 1, tree.order.end(),
                          [&](std::size_t i, std::size_t j) { return off_half(i) < off_half(j); });
    part[branch] = added;
    for (const std::size_t i : tree.order)  // parents come before their children
        if (i != far && part[tree.parent[i]] == added) part[i] = added;
}

// Parts 0 .. parts-1 of a connected graph, each non-empty and connected. With few vertices per part METIS is not used:
// it would leave parts empty and print messages.
Parts cut(Graph& graph, std::int32_t parts) {
    constexpr std::size_t enough = 12;
    Parts part(graph.size(), 0);
    if (parts > 1 && graph.size() >= enough * index(parts)) {
        const std::vector<idx_t> found = cut_with_metis(graph, parts);
        part.assign(found.begin(), found.end());
        mend(graph, part, parts);
    }
    for (;;) {
        std::vector<std::int64_t> size(index(parts), 0);
        for (const std::int32_t p : part) ++size[index(p)];
        const auto empty = std::find(size.begin(), size.end(), 0);
        if (empty == size.end()) return part;
        const auto largest = std::max_element(size.begin(), size.end());
        halve(graph, part, static_cast<std::int32_t>(largest - size.begin()),
              static_cast<std::int32_t>(empty - size.begin()));
    }
}

Graph graph_of(const FaceTable& table, std::span<const std::size_t> members, std::span<const idx_t> number) {
    Graph graph;
    for (const std::size_t i : members) {
        poll_cancel("partition");
        for (std::size_t f = 0; f < index(FaceTable::stride); ++f) {
            const std::int64_t j = table.neighbour[i * index(FaceTable::stride) + f];
            if (j >= 0) graph.neighbour.push_back(number[index(j)]);
        }
        graph.start.push_back(static_cast<idx_t>(graph.neighbour.size()));
    }
    return graph;
}

// A face-connected part of a body.
struct Component {
    std::int32_t body;
    std::vector<std::size_t> cells;  // positions in the list of all cells
    std::int64_t parts = 1;
};

// One part for each component; each further part goes to the component with the most cells per part.
void share_out(std::vector<Component>& components, std::int64_t subdomains) {
    using Load = std::pair<double, std::size_t>;
    const auto load = [&](std::size_t c) {
        return static_cast<double>(components[c].cells.size()) / static_cast<double>(components[c].parts);
    };
    const auto lighter = [](const Load& a, const Load& b) {
        return a.first < b.first || (a.first == b.first && a.second > b.second);
    };
    std::vector<Load> heap;
    for (std::size_t c = 0; c < components.size(); ++c) heap.emplace_back(load(c), c);
    std::make_heap(heap.begin(), heap.end(), lighter);
    for (auto n = static_cast<std::int64_t>(components.size()); n < subdomains; ++n) {
        std::pop_heap(heap.begin(), heap.end(), lighter);
        const std::size_t c = heap.back().second;
        ++components[c].parts;
        heap.back() = {load(c), c};
        std::push_heap(heap.begin(), heap.end(), lighter);
    }
}

}  // namespace

Partition partition(const Mesh& mesh, std::int64_t subdomains, std::span<const std::uint8_t> left_out) {
    std::vector<std::int64_t> all;
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c)
        if (left_out.empty() || left_out[index(mesh.cell_body(c))] == 0) all.push_back(c);
    const auto cells = static_cast<std::int64_t>(all.size());
    if (subdomains < 0 || subdomains > std::max<std::int64_t>(cells, 1))
        fail(DELAM_ERROR_ARGUMENT, "subdomains ", subdomains, ": must be in 0..", cells, ", the number of cells");
    if (cells > std::numeric_limits<idx_t>::max() / FaceTable::stride)
        fail(DELAM_ERROR_ARGUMENT, cells, " cells: METIS was built for fewer");

    Partition result;
    result.cell_subdomain.assign(index(mesh.cell_count()), -1);
    if (all.empty()) return result;
    Parts body(index(cells));
    for (std::size_t c = 0; c < all.size(); ++c) body[c] = mesh.cell_body(all[c]);
    const FaceTable table = match_faces(mesh, all);  // bodies share no nodes, hence no faces
    std::vector<std::size_t> members(index(cells));
    std::vector<idx_t> number(index(cells));
    for (std::size_t c = 0; c < index(cells); ++c) {
        members[c] = c;
        number[c] = static_cast<idx_t>(c);
    }
    std::vector<std::int32_t> piece;
    const std::int32_t count = pieces(graph_of(table, members, number), body, piece);
    std::vector<Component> components(index(count));
    for (std::size_t c = 0; c < index(cells); ++c) {
        Component& component = components[index(piece[c])];
        component.body = body[c];
        number[c] = static_cast<idx_t>(component.cells.size());
        component.cells.push_back(c);
    }
    std::stable_sort(components.begin(), components.end(),
                     [](const Component& a, const Component& b) { return a.body < b.body; });
    share_out(components, subdomains);

    for (const Component& component : components) {
        Graph graph = graph_of(table, component.cells, number);
        const Parts part = cut(graph, static_cast<std::int32_t>(component.parts));
        // Parts are numbered in the order of their first cells.
        std::vector<std::int32_t> name(index(component.parts), -1);
        for (std::size_t k = 0; k < component.cells.size(); ++k) {
            std::int32_t& n = name[index(part[k])];
            if (n < 0) {
                n = static_cast<std::int32_t>(result.subdomain_body.size());
                result.subdomain_body.push_back(component.body);
            }
            result.cell_subdomain[index(all[component.cells[k]])] = n;
        }
    }
    return result;
}

}  // namespace delam
