// SPDX-License-Identifier: BSD-3-Clause
// Blocks of cells that do not match, projected onto each other, for the tests of projections.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "check.hpp"
#include "delam/delam.h"
#include "mesh/face_gaps.hpp"
#include "mesh/layers.hpp"
#include "mesh/mesh.hpp"
#include "mesh/pairing/interfaces.hpp"
#include "mesh/rule/mid_sides.hpp"
#include "refused.hpp"

namespace unit {

using namespace delam;

using Labels = std::vector<std::int32_t>;
using Indices = std::vector<std::int64_t>;
using Numbers = std::vector<double>;

inline bool quadratic(CellType type) { return topology(type).nodes > topology(type).corners; }

using Map = std::function<void(std::span<double>)>;

// Blocks of cells of their own types, each given by a corner, sides and divisions along x, (y,) and the last axis;
// bodies in the order of the list.
struct Block {
    CellType type;
    Numbers corner, sides;
    Indices divisions;
};
inline Mesh blocks(const std::vector<Block>& list, const Map& map = {}, const Numbers& extra = {}) {
    const int dim = topology(list[0].type).dimension;
    Numbers nodes;
    std::vector<Mesh> parts;
    for (const Block& b : list) {
        parts.push_back(make_layers(dim, Numbers(b.sides.begin(), b.sides.end() - 1),
                                    Indices(b.divisions.begin(), b.divisions.end() - 1), Numbers{b.sides.back()},
                                    Indices{b.divisions.back()}, b.type));
        for (std::int64_t n = 0; n < parts.back().node_count(); ++n) {
            Numbers x(parts.back().node(n).begin(), parts.back().node(n).end());
            for (std::size_t i = 0; i < x.size(); ++i) x[i] += b.corner[i];
            if (map) map(x);
            nodes.insert(nodes.end(), x.begin(), x.end());
        }
    }
    nodes.insert(nodes.end(), extra.begin(), extra.end());
    Mesh mesh(dim, nodes);
    std::int64_t first = 0;
    for (std::size_t k = 0; k < parts.size(); ++k) {
        for (std::int64_t c = 0; c < parts[k].cell_count(); ++c) {
            Indices cell(parts[k].cell(c).begin(), parts[k].cell(c).end());
            for (std::int64_t& n : cell) n += first;
            mesh.add_cells(list[k].type, cell, Labels{static_cast<std::int32_t>(k)});
        }
        first += parts[k].node_count();
    }
    return mesh;
}

// A block of `lower` divisions below one of `upper`, which covers x from `start` on.
inline std::vector<Block> stack(CellType lower_type, CellType upper_type, std::int64_t lower, std::int64_t upper,
                                double start = 0.0, double length = 1.0) {
    if (topology(lower_type).dimension == 2)
        return {{lower_type, {0, 0}, {1, 0.5}, {lower, 2}}, {upper_type, {start, 0.5}, {length, 0.5}, {upper, 2}}};
    return {{lower_type, {0, 0, 0}, {1, 1, 0.5}, {lower, lower + 1, 1}},
            {upper_type, {start, 0, 0.5}, {length, 1, 0.5}, {upper, upper + 2, 1}}};
}

inline double linear(std::span<const double> x) {
    double value = 0.7;
    for (std::size_t i = 0; i < x.size(); ++i) value += (0.3 - 1.1 * static_cast<double>(i)) * x[i];
    return value;
}

// Tied nodes lie where their weights put them; the weights sum to one and reproduce linear fields; tied nodes belong to
// no body and depend on one.
inline void expect_ties(const Mesh& mesh, const InterfaceGeometry& i) {
    std::size_t middles = 0;  // pairs at mid-side nodes, which have two tied nodes more
    for (const std::int64_t node : i.node_b) middles += mesh.node_body(node) < 0 ? 1 : 0;
    ck_assert_uint_eq(mesh.ties().size(), i.node_a.size() + 2 * middles);
    const auto first_of_middles = static_cast<std::ptrdiff_t>(i.node_a.size());
    for (const NodeTie& tie : std::span(mesh.ties()).first(i.node_a.size())) {
        double sum = 0.0;
        double value = 0.0;
        for (const auto& [node, weight] : tie.of) {
            ck_assert_int_eq(mesh.node_body(node), i.body_a);
            sum += weight;
            value += weight * linear(mesh.node(node));
        }
        ck_assert(std::abs(sum - 1.0) < 1e-14);
        ck_assert(std::abs(value - linear(mesh.node(tie.node))) < 1e-14);
        ck_assert_int_eq(mesh.node_body(tie.node), -1);
        ck_assert_int_eq(mesh.node_origin(tie.node), tie.node);
        ck_assert(std::any_of(i.node_a.begin(), i.node_a.end(),
                              [&](std::int64_t node) { return node_of_pair(mesh, node) == tie.node; }));
    }
    for (auto tie = mesh.ties().begin() + first_of_middles; tie != mesh.ties().end(); ++tie) {
        double sum = 0.0, value = 0.0;
        for (const auto& [node, weight] : tie->of) {
            sum += weight;
            value += weight * linear(mesh.node(node));
            ck_assert_int_eq(mesh.node_body(node), mesh.node_body(tie->of.front().first));
        }
        ck_assert(std::abs(sum - 1.0) < 1e-14);
        ck_assert(std::abs(value - linear(mesh.node(tie->node))) < 1e-12);
    }
    for (std::size_t p = 0; p < i.node_b.size(); ++p) {
        ck_assert_int_eq(mesh.node_body(node_of_pair(mesh, i.node_b[p])), i.body_b);
        ck_assert(i.weight[p] > 0.0);
    }
    ck_assert(std::is_sorted(mesh.ties().begin(), mesh.ties().end(),
                             [](const NodeTie& x, const NodeTie& y) { return x.node < y.node; }));
}

inline double area(const InterfaceGeometry& i) {
    double sum = 0.0;
    for (const double w : i.weight) sum += w;
    return sum;
}

// Two rings around a quarter circle (a cylinder in 3D), of n and 2 n + 1 cells: b's nodes are off a's faces by the
// distance of the chords from the arc. `rings` has the divisions along the axis of the cylinder.
inline void expect_curved(CellType type, std::int64_t n, const std::vector<Block>& rings,
                          decltype(add_mortar_interface)& add = add_projected_interface) {
    const std::size_t dim = index(topology(type).dimension);
    // x runs around, the last axis is the radius, turned so that cells stay positive.
    const Map bend = [&](std::span<double> x) {
        const double angle = 0.5 * std::numbers::pi * (1.0 - x[0]);
        const double r = 1.0 + x[dim - 1];
        x[0] = r * std::cos(angle);
        x[dim - 1] = r * std::sin(angle);
    };
    Mesh mesh = blocks(rings, bend);
    const double radius = 1.5;
    const double turn = 0.5 * std::numbers::pi / static_cast<double>(n);
    // Sagitta of the chords; of parabolas through three points of the arc, far less.
    const double chord = radius * (1.0 - std::cos(0.5 * turn));
    const double gap = quadratic(type) ? 0.05 * chord : 1.01 * chord;
    add(mesh, 0, 1, gap);
    const InterfaceGeometry& i = mesh.interfaces()[0];
    expect_ties(mesh, i);
    const double exact = 0.5 * std::numbers::pi * radius;
    ck_assert(std::abs(area(i) - exact) < 0.1 * turn * turn * exact);
    for (std::size_t p = 0; p < i.node_a.size(); ++p) {
        const auto a = mesh.node(i.node_a[p]);
        const auto b = mesh.node(i.node_b[p]);
        double off = 0.0;
        double outward = 0.0;
        for (std::size_t k = 0; k < dim; ++k) {
            off = std::max(off, std::abs(a[k] - b[k]));
            if (k == 0 || k == dim - 1) outward += i.frame[p * dim * dim + k] * b[k] / radius;
        }
        ck_assert(off <= gap);
        ck_assert(outward > std::cos(0.6 * turn));
    }
    if (quadratic(type)) return;
    // Chords and arcs lie apart, but the faces touch.
    for (const double distance : face_gaps(mesh, i)) ck_assert(distance == 0.0);
    Mesh close = blocks(rings, bend);
    if (&add == &add_mortar_interface) {
        add(close, 0, 1, 0.5 * chord);
        const InterfaceGeometry& whole = close.interfaces()[0];
        const std::vector<double> distance = pair_distances(close, whole);
        ck_assert(max_abs(distance) > whole.reach);
        return;
    }
    ck_assert_refused(DELAM_ERROR_MESH, "only in part", add(close, 0, 1, 0.5 * chord));
    ck_assert_int_eq(close.node_count(), mesh.node_count() - i.pair_count());
}

}  // namespace unit
