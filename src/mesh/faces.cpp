// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/faces.hpp"

#include <algorithm>
#include <limits>

#include "base/error.hpp"
#include "delam/delam.h"

namespace delam {

namespace {

struct Key {
    std::array<std::int64_t, 4> node;  // ascending; unused entries at the end, beyond every node
    std::int64_t place;                // i*stride + f
    bool operator==(const Key& other) const { return node == other.node; }
};

// Two cells on the two sides of a face walk around it in opposite senses.
bool opposite(std::span<const std::int64_t> a, std::span<const std::int64_t> b) {
    const std::size_t n = a.size();
    const auto k = static_cast<std::size_t>(std::find(b.begin(), b.end(), a[0]) - b.begin());
    return n == 2 ? k == 1 : b[(k + n - 1) % n] == a[1];
}

}  // namespace

std::array<std::int64_t, 4> face_nodes(const Mesh& mesh, std::int64_t cell, int face) {
    const CellTopology& shape = topology(mesh.cell_type(cell));
    const auto& local = shape.face[at(face)];
    std::array<std::int64_t, 4> nodes{};
    for (std::size_t k = 0; k < at(shape.face_nodes); ++k) nodes[k] = mesh.cell(cell)[at(local[k])];
    return nodes;
}

// The half cross product of the diagonals of a quadrilateral holds for a warped one too: it depends on the boundary
// alone.
std::array<double, 3> area_vector(const Mesh& mesh, std::span<const std::int64_t> nodes) {
    if (mesh.dimension() == 2) {
        const auto p = mesh.node(nodes[0]);
        const auto q = mesh.node(nodes[1]);
        return {q[1] - p[1], p[0] - q[0], 0.0};
    }
    const bool triangle = nodes.size() == 3;
    const auto p = mesh.node(nodes[0]);
    const auto q = mesh.node(nodes[1]);
    const auto r = mesh.node(nodes[2]);
    const auto s = mesh.node(nodes[triangle ? 0 : 3]);
    const double u[3] = {r[0] - p[0], r[1] - p[1], r[2] - p[2]};
    const double v[3] = {s[0] - q[0], s[1] - q[1], s[2] - q[2]};
    return {0.5 * (u[1] * v[2] - u[2] * v[1]), 0.5 * (u[2] * v[0] - u[0] * v[2]), 0.5 * (u[0] * v[1] - u[1] * v[0])};
}

// Faces are gathered under their smallest node by a counting sort; the few that meet there are compared directly.
FaceTable match_faces(const Mesh& mesh, std::span<const std::int64_t> cells) {
    constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();
    FaceTable table;
    table.neighbour.assign(cells.size() * at(FaceTable::stride), -1);

    std::vector<std::int64_t> begin(at(mesh.node_count()) + 1, 0);
    const auto each_face = [&](auto&& visit) {
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const CellTopology& shape = topology(mesh.cell_type(cells[i]));
            for (int f = 0; f < shape.faces; ++f) {
                Key key{face_nodes(mesh, cells[i], f), static_cast<std::int64_t>(i) * FaceTable::stride + f};
                std::fill(key.node.begin() + shape.face_nodes, key.node.end(), none);
                std::sort(key.node.begin(), key.node.end());
                visit(key);
            }
        }
    };
    each_face([&](const Key& key) { ++begin[at(key.node[0]) + 1]; });
    for (std::size_t n = 0; n + 1 < begin.size(); ++n) begin[n + 1] += begin[n];
    std::vector<Key> sorted(at(begin.back()));
    {
        std::vector<std::int64_t> next(begin.begin(), begin.end() - 1);
        each_face([&](const Key& key) { sorted[at(next[at(key.node[0])]++)] = key; });
    }

    const auto walk = [&](std::int64_t place) {
        const std::int64_t cell = cells[at(place / FaceTable::stride)];
        const auto nodes = face_nodes(mesh, cell, static_cast<int>(place % FaceTable::stride));
        return std::vector<std::int64_t>(nodes.begin(), nodes.begin() + topology(mesh.cell_type(cell)).face_nodes);
    };
    for (std::size_t n = 0; n + 1 < begin.size(); ++n) {
        for (std::size_t i = at(begin[n]); i < at(begin[n + 1]); ++i) {
            for (std::size_t j = i + 1; j < at(begin[n + 1]); ++j) {
                if (!(sorted[i] == sorted[j])) continue;
                std::int64_t& here = table.neighbour[at(sorted[i].place)];
                std::int64_t& there = table.neighbour[at(sorted[j].place)];
                const std::int64_t a = sorted[i].place / FaceTable::stride;
                const std::int64_t b = sorted[j].place / FaceTable::stride;
                if (here >= 0 || there >= 0 || !opposite(walk(sorted[i].place), walk(sorted[j].place)))
                    fail(DELAM_ERROR_MESH, "cells ", cells[at(a)], " and ", cells[at(b)],
                         " lie on the same side of the face they share: they overlap");
                here = b;
                there = a;
            }
        }
    }
    return table;
}

}  // namespace delam
