// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/faces.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "mesh/points.hpp"

namespace delam {

namespace {

// Corners of a face, ascending; unused entries at the end, beyond every node.
using Corners = std::array<std::int64_t, 4>;

// Two cells on the two sides of a face traverse it in opposite directions.
bool opposite(std::span<const std::int64_t> a, std::span<const std::int64_t> b) {
    const std::size_t n = a.size();
    const auto k = index(std::find(b.begin(), b.end(), a[0]) - b.begin());
    return n == 2 ? k == 1 : b[(k + n - 1) % n] == a[1];
}

// Distance of neighbouring nodes; in a quadratic cell, from a corner to the mid-side node.
double shortest_edge(const Mesh& mesh, std::int64_t c) {
    double shortest = std::numeric_limits<double>::infinity();
    const auto measure = [&](std::int64_t a, std::int64_t b) {
        shortest = std::min(shortest, length(position(mesh, a) - position(mesh, b)));
    };
    const CellTopology& shape = topology(mesh.cell_type(c));
    const auto cell = mesh.cell(c);
    for (const CellFace& face : shape.all_faces()) {
        const std::size_t corners = shape.corners_of(face).size();
        for (std::size_t k = 0; k < corners; ++k) {
            const std::int64_t here = cell[index(face.node[k])];
            const std::int64_t next = cell[index(face.node[(k + 1) % corners])];
            if (face.nodes == corners) {
                measure(here, next);
            } else {
                const std::int64_t between = cell[index(face.node[corners + (corners == 2 ? 0 : k)])];
                measure(here, between);
                measure(between, next);
            }
        }
    }
    return shortest;
}

}  // namespace

BoundaryFace face_of(const Mesh& mesh, std::int64_t cell, std::size_t face) {
    const CellTopology& shape = topology(mesh.cell_type(cell));
    const CellFace& local = shape.face[face];
    BoundaryFace found{cell, static_cast<int>(local.nodes), static_cast<int>(shape.corners_of(local).size()), {}};
    for (std::size_t k = 0; k < local.nodes; ++k) found.node[k] = mesh.cell(cell)[index(local.node[k])];
    return found;
}

std::array<double, 3> area_vector(const Mesh& mesh, std::span<const std::int64_t> nodes) {
    if (mesh.dimension() == 2) {
        const auto p = mesh.node(nodes[0]);
        const auto q = mesh.node(nodes[1]);
        return {q[1] - p[1], p[0] - q[0], 0.0};
    }
    std::array<double, 3> sum{};
    for (const FacePiece& piece : face_pieces(3, nodes.size())) {
        const auto corner = [&](std::size_t k) { return mesh.node(nodes[index(piece.node[k])]); };
        const auto p = corner(0);
        const auto q = corner(1);
        const auto r = corner(2);
        const auto s = corner(piece.nodes == 3 ? 0 : 3);
        const double u[3] = {r[0] - p[0], r[1] - p[1], r[2] - p[2]};
        const double v[3] = {s[0] - q[0], s[1] - q[1], s[2] - q[2]};
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3;
            const std::size_t k = (i + 2) % 3;
            sum[i] += 0.5 * (u[j] * v[k] - u[k] * v[j]);
        }
    }
    return sum;
}

// Each face is compared with those before it that have the same smallest node: a few, listed in their order.
FaceTable match_faces(const Mesh& mesh, std::span<const std::int64_t> cells) {
    constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();
    FaceTable table;
    table.neighbour.assign(cells.size() * index(FaceTable::stride), -1);
    const auto face_at = [&](std::int64_t place) {
        return face_of(mesh, cells[index(place / FaceTable::stride)], index(place % FaceTable::stride));
    };
    const auto join = [&](std::int64_t first, std::int64_t second) {
        std::int64_t& here = table.neighbour[index(first)];
        std::int64_t& there = table.neighbour[index(second)];
        const std::int64_t a = first / FaceTable::stride;
        const std::int64_t b = second / FaceTable::stride;
        const BoundaryFace face = face_at(first);
        const BoundaryFace other = face_at(second);
        if (here >= 0 || there >= 0 || !opposite(face.corner(), other.corner()))
            fail(DELAM_ERROR_MESH, "cells ", cells[index(a)], " and ", cells[index(b)],
                 " lie on the same side of the face they share: they overlap");
        if (face.nodes != other.nodes ||
            !std::is_permutation(face.middle().begin(), face.middle().end(), other.middle().begin()))
            fail(DELAM_ERROR_MESH, "cells ", cells[index(a)], " and ", cells[index(b)], " share the face with corner ",
                 face.node[0], " but not its mid-side nodes: they do not fit together");
        here = b;
        there = a;
    };

    struct Known {
        Corners corner;
        std::int64_t place;  // i*stride + f
        std::int64_t next;   // with the same smallest node, -1: the last
    };
    std::vector<Known> known;
    known.reserve(cells.empty() ? 0 : cells.size() * index(topology(mesh.cell_type(cells.front())).faces));
    std::vector<std::int64_t> first(index(mesh.node_count()), -1);  // face of a smallest node
    for (std::size_t i = 0; i < cells.size(); ++i) {
        poll_cancel("mesh");
        const CellTopology& shape = topology(mesh.cell_type(cells[i]));
        const std::span<const std::int64_t> cell = mesh.cell(cells[i]);
        for (std::size_t f = 0; f < index(shape.faces); ++f) {
            Known face{{none, none, none, none}, static_cast<std::int64_t>(i * index(FaceTable::stride) + f), -1};
            const std::span<const int> local = shape.corners_of(shape.face[f]);
            for (std::size_t k = 0; k < local.size(); ++k) face.corner[k] = cell[index(local[k])];
            std::sort(face.corner.begin(), face.corner.end());
            std::int64_t* end = &first[index(face.corner[0])];
            for (; *end >= 0; end = &known[index(*end)].next)
                if (known[index(*end)].corner == face.corner) join(known[index(*end)].place, face.place);
            *end = static_cast<std::int64_t>(known.size());
            known.push_back(face);
        }
    }
    return table;
}

double shortest_edge(const Mesh& mesh, std::span<const std::int64_t> cells) {
    double shortest = std::numeric_limits<double>::infinity();
    for (const std::int64_t c : cells) {
        poll_cancel("mesh");
        shortest = std::min(shortest, shortest_edge(mesh, c));
    }
    return shortest;
}

Box box_of(const Mesh& mesh, const BoundaryFace& face, double widened) {
    Box box{position(mesh, face.node[0]), position(mesh, face.node[0])};
    for (const std::int64_t node : face.all()) {
        const Point p = position(mesh, node);
        for (std::size_t i = 0; i < 3; ++i) {
            box.low[i] = std::min(box.low[i], p[i]);
            box.high[i] = std::max(box.high[i], p[i]);
        }
    }
    for (std::size_t i = 0; i < 3; ++i) {
        box.low[i] -= widened;
        box.high[i] += widened;
    }
    return box;
}

std::vector<BoundaryFace> boundary_faces(const Mesh& mesh, std::int32_t body) {
    const std::vector<std::int64_t> cells = mesh.body_cells(body);
    const FaceTable table = match_faces(mesh, cells);
    std::vector<BoundaryFace> faces;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        poll_cancel("mesh");
        const std::size_t count = index(topology(mesh.cell_type(cells[i])).faces);
        for (std::size_t f = 0; f < count; ++f)
            if (table.neighbour[i * index(FaceTable::stride) + f] < 0) faces.push_back(face_of(mesh, cells[i], f));
    }
    return faces;
}

namespace {

// Originals of nodes, each once and ascending: what tells a face.
using Key = std::vector<std::int64_t>;

Key key_of(const Mesh& mesh, std::span<const std::int64_t> nodes) {
    Key key;
    for (const std::int64_t node : nodes) key.push_back(mesh.node_origin(node));
    std::sort(key.begin(), key.end());
    key.erase(std::unique(key.begin(), key.end()), key.end());
    return key;
}

std::string listed(std::span<const std::int64_t> nodes) {
    std::string text;
    for (const std::int64_t node : nodes) text += (text.empty() ? "" : ", ") + std::to_string(node);
    return text;
}

// The given faces, by their keys, and whether cells have them.
class GivenFaces {
public:
    GivenFaces(const Mesh& mesh, std::span<const std::int64_t> faces, std::size_t per_face)
        : mesh_(mesh), faces_(faces), per_face_(per_face), on_face_(index(mesh.node_count()), 0) {
        for (std::size_t i = 0; i < faces.size(); ++i)
            if (faces[i] < 0 || faces[i] >= mesh.node_count())
                fail(DELAM_ERROR_ARGUMENT, "face ", i / per_face, ": node ", faces[i], ": must be in 0..",
                     mesh.node_count() - 1);
        for (std::size_t f = 0; f < count(); ++f) {
            Key key = key_of(mesh, nodes(f));
            for (const std::int64_t node : key) on_face_[index(node)] = 1;
            known_.emplace(std::move(key), f);
        }
        met_.assign(count(), 0);
    }

    // True if the node, or the one it was doubled from, is one of a face.
    bool has(std::int64_t node) const { return on_face_[index(mesh_.node_origin(node))] != 0; }
    // True if the face is one of them, which is then met.
    bool meet(const BoundaryFace& face) {
        for (const std::span<const std::int64_t> own : {face.corner(), face.all()}) {
            const auto found = known_.find(key_of(mesh_, own));
            if (found == known_.end()) continue;
            met_[found->second] = 1;
            return true;
        }
        return false;
    }
    void require_all_met() const {
        for (const auto& [key, f] : known_)
            if (met_[f] == 0)
                fail(DELAM_ERROR_MESH, "face ", f, " with nodes ", listed(nodes(f)),
                     ": no two cells of one body share it");
    }

private:
    std::size_t count() const { return faces_.size() / per_face_; }
    std::span<const std::int64_t> nodes(std::size_t f) const { return faces_.subspan(f * per_face_, per_face_); }

    const Mesh& mesh_;
    std::span<const std::int64_t> faces_;
    std::size_t per_face_;
    std::map<Key, std::size_t> known_;
    std::vector<std::uint8_t> on_face_;  // [nodes] of originals
    std::vector<std::uint8_t> met_;      // [faces]
};

// The cells at a cut, and which of their faces belong to it.
class CellsAtCut {
public:
    CellsAtCut(const Mesh& mesh, GivenFaces& given) : mesh_(mesh) {
        for (std::int64_t c = 0; c < mesh.cell_count(); ++c) {
            poll_cancel("mesh");
            const auto nodes = mesh.cell(c);
            if (std::any_of(nodes.begin(), nodes.end(), [&](std::int64_t n) { return given.has(n); }))
                cells_.push_back(c);
        }
        table_ = match_faces(mesh, cells_);
        cut_.assign(table_.neighbour.size(), 0);
        for (std::size_t i = 0; i < cells_.size(); ++i)
            for (std::size_t f = 0; f < faces_of(i); ++f) {
                const BoundaryFace face = face_of(mesh, cells_[i], f);
                const std::size_t at = i * index(FaceTable::stride) + f;
                if (table_.neighbour[at] < 0 || !given.meet(face)) continue;
                cut_[at] = 1;
                for (const std::int64_t node : face.all()) around_[node];
            }
        for (std::size_t i = 0; i < cells_.size(); ++i)
            for (const std::int64_t node : mesh.cell(cells_[i]))
                if (const auto at = around_.find(node); at != around_.end()) at->second.push_back(i);
    }

    // Returns which cells take a copy of which node.
    std::vector<DoubledNode> copies() const {
        std::vector<DoubledNode> made;
        for (const auto& [node, around] : around_) {
            poll_cancel("mesh");
            const std::vector<std::size_t> before = parts(node, around, false), after = parts(node, around, true);
            std::map<std::size_t, std::size_t> copy_of;  // of a part: its place in `made`
            for (std::size_t i = 0; i < around.size(); ++i) {
                if (after[i] == before[i]) continue;  // the part of the first cell keeps the node
                const auto [part, first] = copy_of.try_emplace(after[i], made.size());
                if (first) made.push_back({node, {}});
                made[part->second].cells.push_back(cells_[around[i]]);
            }
        }
        return made;
    }

private:
    std::size_t faces_of(std::size_t i) const { return index(topology(mesh_.cell_type(cells_[i])).faces); }

    // Returns for each cell around a node the first one, in this list, to which it is connected across faces with this
    // node; opened: but not across those of the cut.
    std::vector<std::size_t> parts(std::int64_t node, const std::vector<std::size_t>& around, bool opened) const {
        std::vector<std::size_t> first(around.size());
        std::iota(first.begin(), first.end(), std::size_t{0});
        const auto root = [&](std::size_t i) {
            while (first[i] != i) i = first[i];
            return i;
        };
        for (std::size_t i = 0; i < around.size(); ++i)
            for (std::size_t f = 0; f < faces_of(around[i]); ++f) {
                const std::size_t at = around[i] * index(FaceTable::stride) + f;
                if (table_.neighbour[at] < 0 || (opened && cut_[at] != 0)) continue;
                const BoundaryFace face = face_of(mesh_, cells_[around[i]], f);
                if (std::find(face.all().begin(), face.all().end(), node) == face.all().end()) continue;
                const auto other = std::lower_bound(around.begin(), around.end(), index(table_.neighbour[at]));
                const std::size_t a = root(i), b = root(index(other - around.begin()));
                first[std::max(a, b)] = std::min(a, b);
            }
        for (std::size_t i = 0; i < first.size(); ++i) first[i] = root(i);
        return first;
    }

    const Mesh& mesh_;
    std::vector<std::int64_t> cells_;
    FaceTable table_;                                          // of cells_
    std::vector<std::uint8_t> cut_;                            // like it: 1 on faces of the cut
    std::map<std::int64_t, std::vector<std::size_t>> around_;  // of each node on a cut face: the cells, ascending
};

}  // namespace

std::int64_t cut(Mesh& mesh, std::span<const std::int64_t> faces, std::size_t per_face) {
    if (faces.empty()) fail(DELAM_ERROR_ARGUMENT, "faces: a cut needs at least one");
    GivenFaces given(mesh, faces, per_face);
    const CellsAtCut at(mesh, given);
    given.require_all_met();
    const std::vector<DoubledNode> copies = at.copies();
    if (copies.empty())
        fail(DELAM_ERROR_MESH,
             "the faces open nothing: around each of their nodes the cells stay connected across other faces");
    mesh.double_nodes(copies);
    return static_cast<std::int64_t>(copies.size());
}

}  // namespace delam
