// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/faces.hpp"

#include <algorithm>
#include <limits>

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

}  // namespace delam
