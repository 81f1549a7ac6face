// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/part/glued_cells.hpp"

#include <algorithm>
#include <numeric>

#include "base/numbers.hpp"
#include "petsc/base/failure.hpp"

namespace delam::petsc {

namespace {

void require(std::int32_t status, const char* call) {
    if (status != DELAM_OK) fail(status, call, " returned ", delam_status_name(status));
}

struct Cells {
    std::int64_t dimension = 0;
    std::vector<std::int64_t> start, node;           // all nodes of each cell
    std::vector<std::int64_t> corner_start, corner;  // its corners
    std::vector<std::int64_t> cell_start, cell;      // cells at each node, ascending
    std::int64_t count() const { return static_cast<std::int64_t>(start.size()) - 1; }
};

std::vector<std::int64_t> corners_by_type() {
    std::vector<std::int64_t> corners;
    for (std::int64_t i = 0; i < delam_cell_type_count(); ++i) {
        std::int32_t type = 0, count = 0;
        require(delam_cell_type_info(i, nullptr, &type, nullptr, nullptr, &count, nullptr, nullptr, nullptr),
                "delam_cell_type_info");
        corners.resize(std::max(corners.size(), index(type) + 1), 0);
        corners[index(type)] = count;
    }
    return corners;
}

Cells read_cells(const delam_mesh* mesh) {
    Cells cells;
    std::int32_t dimension = 0;
    std::int64_t nodes = 0, count = 0, needed = 0;
    require(delam_mesh_size(mesh, &dimension, &nodes, &count, nullptr, nullptr), "delam_mesh_size");
    cells.dimension = dimension;
    std::vector<std::int32_t> types(index(count)), bodies(index(count));
    cells.start.resize(index(count) + 1);
    require(delam_mesh_cells(mesh, types.data(), bodies.data(), cells.start.data(), 0, nullptr, &needed),
            "delam_mesh_cells");
    cells.node.resize(index(needed));
    require(delam_mesh_cells(mesh, types.data(), bodies.data(), cells.start.data(), needed, cells.node.data(), &needed),
            "delam_mesh_cells");
    const std::vector<std::int64_t> corners = corners_by_type();
    cells.corner_start.push_back(0);
    for (std::int64_t c = 0; c < count; ++c) {
        const auto first = cells.node.begin() + cells.start[index(c)];
        cells.corner.insert(cells.corner.end(), first, first + corners[index(types[index(c)])]);
        cells.corner_start.push_back(static_cast<std::int64_t>(cells.corner.size()));
    }
    cells.cell_start.assign(index(nodes) + 1, 0);
    for (const std::int64_t node : cells.node) ++cells.cell_start[index(node) + 1];
    std::partial_sum(cells.cell_start.begin(), cells.cell_start.end(), cells.cell_start.begin());
    cells.cell.resize(cells.node.size());
    std::vector<std::int64_t> next(cells.cell_start.begin(), cells.cell_start.end() - 1);
    for (std::int64_t c = 0; c < count; ++c)
        for (std::int64_t i = cells.start[index(c)]; i < cells.start[index(c) + 1]; ++i)
            cells.cell[index(next[index(cells.node[index(i)])]++)] = c;
    return cells;
}

// Sets that grow together (R. Tarjan, J. ACM 22 (1975) 215-225).
class Sets {
public:
    explicit Sets(std::int64_t count) : parent_(index(count)) { std::iota(parent_.begin(), parent_.end(), 0); }
    std::int64_t root(std::int64_t i) {
        while (parent_[index(i)] != i) i = parent_[index(i)] = parent_[index(parent_[index(i)])];
        return i;
    }
    void join(std::int64_t a, std::int64_t b) {
        a = root(a);
        b = root(b);
        parent_[index(std::max(a, b))] = std::min(a, b);
    }

private:
    std::vector<std::int64_t> parent_;
};

// The first cell that has all of these nodes, or -1.
std::int64_t common_cell(const Cells& cells, const std::vector<std::int64_t>& nodes) {
    const std::int64_t lead = nodes.front();
    for (std::int64_t i = cells.cell_start[index(lead)]; i < cells.cell_start[index(lead) + 1]; ++i) {
        const std::int64_t c = cells.cell[index(i)];
        const auto first = cells.node.begin() + cells.start[index(c)],
                   last = cells.node.begin() + cells.start[index(c) + 1];
        const auto in_cell = [&](std::int64_t node) { return std::find(first, last, node) != last; };
        if (std::all_of(nodes.begin(), nodes.end(), in_cell)) return c;
    }
    return -1;
}

// Joins the cells on both sides of each face and, for pairs in no such face, a cell on each side. What has no cell, an
// obstacle or a point between nodes, stays alone.
void join_across(const delam_mesh* mesh, std::int64_t interface, const Cells& cells, Sets& sets) {
    std::int32_t per_face = 0, body_a = 0, body_b = 0;
    std::int64_t pairs = 0, faces = 0;
    require(delam_mesh_interface_size(mesh, interface, &body_a, &body_b, &pairs, &faces, &per_face),
            "delam_mesh_interface_size");
    if (body_a < 0) return;
    const auto d = index(cells.dimension);
    std::vector<std::int64_t> a(index(pairs)), b(index(pairs)), face(index(faces * per_face));
    std::vector<double> weights(index(pairs)), frames(index(pairs) * d * d);
    require(delam_mesh_interface_pairs(mesh, interface, a.data(), b.data(), weights.data(), frames.data()),
            "delam_mesh_interface_pairs");
    require(delam_mesh_interface_faces(mesh, interface, face.data()), "delam_mesh_interface_faces");
    std::vector<std::uint8_t> joined(index(pairs), 0);
    for (std::int64_t f = 0; f < faces; ++f) {
        std::vector<std::int64_t> side_a, side_b;
        for (std::int64_t i = f * per_face; i < (f + 1) * per_face; ++i) {
            side_a.push_back(a[index(face[index(i)])]);
            side_b.push_back(b[index(face[index(i)])]);
        }
        const std::int64_t cell_a = common_cell(cells, side_a), cell_b = common_cell(cells, side_b);
        if (cell_a < 0 || cell_b < 0) continue;
        sets.join(cell_a, cell_b);
        for (std::int64_t i = f * per_face; i < (f + 1) * per_face; ++i) joined[index(face[index(i)])] = 1;
    }
    for (std::size_t p = 0; p < joined.size(); ++p) {
        if (joined[p] != 0) continue;
        const std::int64_t cell_a = common_cell(cells, {a[p]}), cell_b = common_cell(cells, {b[p]});
        if (cell_a >= 0 && cell_b >= 0) sets.join(cell_a, cell_b);
    }
}

// Vertices whose cells share as many corners as a face has at least.
void find_neighbours(const Cells& cells, GluedCells& graph) {
    std::vector<std::pair<std::int64_t, std::int64_t>> edges;
    std::vector<std::int64_t> shared(index(cells.count()), 0), met;
    for (std::int64_t c = 0; c < cells.count(); ++c) {
        for (std::int64_t i = cells.corner_start[index(c)]; i < cells.corner_start[index(c) + 1]; ++i) {
            const std::int64_t node = cells.corner[index(i)];
            for (std::int64_t k = cells.cell_start[index(node)]; k < cells.cell_start[index(node) + 1]; ++k)
                if (shared[index(cells.cell[index(k)])]++ == 0) met.push_back(cells.cell[index(k)]);
        }
        const std::int64_t from = graph.vertex[index(c)];
        for (const std::int64_t other : met) {
            const std::int64_t to = graph.vertex[index(other)];
            if (shared[index(other)] >= cells.dimension && to != from) edges.emplace_back(from, to);
            shared[index(other)] = 0;
        }
        met.clear();
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    graph.start.assign(graph.cells.size() + 1, 0);
    for (const auto& [from, to] : edges) {
        ++graph.start[index(from) + 1];
        graph.neighbour.push_back(to);
    }
    std::partial_sum(graph.start.begin(), graph.start.end(), graph.start.begin());
}

}  // namespace

GluedCells glue_cells(const delam_mesh* mesh) {
    const Cells cells = read_cells(mesh);
    Sets sets(cells.count());
    std::int64_t interfaces = 0;
    require(delam_mesh_size(mesh, nullptr, nullptr, nullptr, nullptr, &interfaces), "delam_mesh_size");
    for (std::int64_t i = 0; i < interfaces; ++i) join_across(mesh, i, cells, sets);
    GluedCells graph;
    graph.vertex.assign(index(cells.count()), -1);
    for (std::int64_t c = 0; c < cells.count(); ++c) {
        const std::int64_t root = sets.root(c);  // at most c
        if (root == c) {
            graph.vertex[index(c)] = static_cast<std::int64_t>(graph.cells.size());
            graph.cells.push_back(0);
        }
        graph.vertex[index(c)] = graph.vertex[index(root)];
        ++graph.cells[index(graph.vertex[index(c)])];
    }
    find_neighbours(cells, graph);
    return graph;
}

}  // namespace delam::petsc
