// SPDX-License-Identifier: BSD-3-Clause
//
// From two bodies to an interface: their boundary nodes are matched in space, then their boundary faces through the
// nodes, and what the faces know (area, normal) is brought to the node pairs.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "base/error.hpp"
#include "delam/delam.h"
#include "mesh/box_tree.hpp"
#include "mesh/faces.hpp"
#include "mesh/mesh.hpp"
#include "mesh/nodal_rule.hpp"
#include "mesh/overlap.hpp"

namespace delam {

namespace {

Point position(const Mesh& mesh, std::int64_t node) {
    Point p{};
    std::copy(mesh.node(node).begin(), mesh.node(node).end(), p.begin());
    return p;
}

std::string place(const Mesh& mesh, std::int64_t node) {
    const auto p = mesh.node(node);
    return p.size() == 2 ? text("(", p[0], ", ", p[1], ")") : text("(", p[0], ", ", p[1], ", ", p[2], ")");
}

// Between neighbouring nodes: of a quadratic cell, from a corner to the mid-side node.
double shortest_edge(const Mesh& mesh, std::int32_t body) {
    double shortest = std::numeric_limits<double>::infinity();
    const auto measure = [&](std::int64_t a, std::int64_t b) {
        const Point p = position(mesh, a);
        const Point q = position(mesh, b);
        shortest = std::min(shortest, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
    };
    for (const std::int64_t c : mesh.body_cells(body)) {
        const CellTopology& shape = topology(mesh.cell_type(c));
        const auto cell = mesh.cell(c);
        const auto corners = at(shape.face_corners);
        for (std::size_t f = 0; f < at(shape.faces); ++f) {
            for (std::size_t k = 0; k < corners; ++k) {
                const std::int64_t here = cell[at(shape.face[f][k])];
                const std::int64_t next = cell[at(shape.face[f][(k + 1) % corners])];
                if (shape.face_nodes == shape.face_corners) {
                    measure(here, next);
                } else {
                    const std::int64_t between = cell[at(shape.face[f][corners + (corners == 2 ? 0 : k)])];
                    measure(here, between);
                    measure(between, next);
                }
            }
        }
    }
    return shortest;
}

std::vector<std::int64_t> distinct_nodes(std::span<const BoundaryFace> faces) {
    std::vector<std::int64_t> nodes;
    for (const BoundaryFace& face : faces) nodes.insert(nodes.end(), face.all().begin(), face.all().end());
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
}

BoxTree tree_of(const Mesh& mesh, std::span<const std::int64_t> nodes) {
    std::vector<Box> boxes;
    boxes.reserve(nodes.size());
    for (const std::int64_t node : nodes) boxes.push_back({position(mesh, node), position(mesh, node)});
    return BoxTree(std::move(boxes));
}

// Node of a that each node of b coincides with, by mesh node; -1: none.
std::vector<std::int64_t> match_nodes(const Mesh& mesh, std::span<const std::int64_t> a,
                                      std::span<const std::int64_t> b, double distance) {
    std::vector<std::int64_t> partner(at(mesh.node_count()), -1);
    const BoxTree tree = tree_of(mesh, a);
    for (const std::int64_t node : b) {
        const auto found = tree.nearest(position(mesh, node), distance);
        if (found.index >= 0) partner[at(node)] = a[at(found.index)];
    }
    return partner;
}

using FaceKey = std::array<std::int64_t, 4>;
FaceKey sorted_key(std::span<const std::int64_t> nodes) {
    FaceKey key;
    key.fill(std::numeric_limits<std::int64_t>::max());
    std::copy(nodes.begin(), nodes.end(), key.begin());
    std::sort(key.begin(), key.end());
    return key;
}

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

struct Matching {
    std::vector<BoundaryFace> on_a;                             // matched faces, as body a has them
    std::vector<std::pair<std::int64_t, std::int64_t>> node;    // matched nodes (a, b), ascending
    std::vector<BoundaryFace> left_a, left_b;                   // faces without a match
};

// Two faces whose corners coincide are one face. A mid-side node of either that meets none of the other is an error:
// named here, since such faces lie on each other as they should.
void require_same_middle(const Mesh& mesh, const BoundaryFace& a, const BoundaryFace& b,
                         std::span<const std::int64_t> partner) {
    std::vector<std::int64_t> met;
    const auto refuse = [&](std::int64_t node) {
        fail(DELAM_ERROR_MESH, "the face that cells ", a.cell, " and ", b.cell, " of the two bodies share at ",
             place(mesh, a.node[0]), ": mid-side node ", node, " at ", place(mesh, node),
             " has no partner on the other side: the nodes do not match");
    };
    for (const std::int64_t node : b.middle()) {
        const std::int64_t image = partner[at(node)];
        if (std::find(a.middle().begin(), a.middle().end(), image) == a.middle().end()) refuse(node);
        met.push_back(image);
    }
    for (const std::int64_t node : a.middle())
        if (std::find(met.begin(), met.end(), node) == met.end()) refuse(node);
}

// Faces are found by their corners.
Matching match_boundaries(const Mesh& mesh, std::span<const BoundaryFace> faces_a,
                          std::span<const BoundaryFace> faces_b, std::span<const std::int64_t> partner) {
    std::vector<std::pair<FaceKey, std::size_t>> known;
    known.reserve(faces_a.size());
    for (std::size_t f = 0; f < faces_a.size(); ++f) known.emplace_back(sorted_key(faces_a[f].corner()), f);
    std::sort(known.begin(), known.end());

    Matching m;
    std::vector<char> used(faces_a.size(), 0);
    for (const BoundaryFace& face : faces_b) {
        std::array<std::int64_t, 4> image{};
        bool complete = true;
        for (std::size_t k = 0; k < face.corner().size(); ++k) {
            image[k] = partner[at(face.node[k])];
            complete = complete && image[k] >= 0;
        }
        const FaceKey key = sorted_key(std::span(image).first(face.corner().size()));
        const auto found = std::lower_bound(known.begin(), known.end(), std::pair(key, std::size_t{0}));
        if (!complete || found == known.end() || found->first != key) {
            m.left_b.push_back(face);
            continue;
        }
        const BoundaryFace& other = faces_a[found->second];
        if (dot(area_vector(mesh, face.all()), area_vector(mesh, other.all())) >= 0.0)
            fail(DELAM_ERROR_MESH, "cells ", other.cell, " and ", face.cell, " of the two bodies lie on the same side ",
                 "of the face they share at ", place(mesh, face.node[0]), ": the bodies overlap");
        require_same_middle(mesh, other, face, partner);
        used[found->second] = 1;
        for (const std::int64_t node : face.all()) m.node.emplace_back(partner[at(node)], node);
    }
    for (std::size_t f = 0; f < faces_a.size(); ++f) (used[f] ? m.on_a : m.left_a).push_back(faces_a[f]);
    std::sort(m.node.begin(), m.node.end());
    m.node.erase(std::unique(m.node.begin(), m.node.end()), m.node.end());
    for (std::size_t i = 1; i < m.node.size(); ++i)
        if (m.node[i].first == m.node[i - 1].first)
            fail(DELAM_ERROR_MESH, "nodes ", m.node[i - 1].second, " and ", m.node[i].second,
                 " both coincide with node ", m.node[i].first, " at ", place(mesh, m.node[i].first));
    return m;
}

// Orders places by x, then y, then z, where coordinates closer than `distance` count as equal: rounding in the nodes
// of a straight interface must not shuffle it.
std::vector<std::size_t> spatial_order(const Mesh& mesh, std::span<const std::pair<std::int64_t, std::int64_t>> pairs,
                                       double distance) {
    std::vector<std::size_t> order(pairs.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::vector<std::array<std::int64_t, 3>> rank(pairs.size(), {0, 0, 0});
    for (std::size_t axis = 0; axis < at(mesh.dimension()); ++axis) {
        const auto x = [&](std::size_t i) { return mesh.node(pairs[i].first)[axis]; };
        std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return x(i) < x(j); });
        for (std::size_t k = 1; k < order.size(); ++k)
            rank[order[k]][axis] = rank[order[k - 1]][axis] + (x(order[k]) - x(order[k - 1]) > distance ? 1 : 0);
    }
    std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
        return std::pair(rank[i], pairs[i].first) < std::pair(rank[j], pairs[j].first);
    });
    return order;
}

// Rows normal, tangent(s). In the plane the tangent is the normal turned clockwise; in space the first one is the x
// axis laid into the face, or the y axis where the normal is close to x, and the second completes a right-handed
// frame.
void write_frame(int dimension, const Point& area, double* frame) {
    const double length = std::hypot(area[0], area[1], area[2]);
    Point n;
    for (std::size_t i = 0; i < 3; ++i) n[i] = area[i] / length;
    if (dimension == 2) {
        const double rows[] = {n[0], n[1], n[1], -n[0]};
        std::copy(std::begin(rows), std::end(rows), frame);
        return;
    }
    const std::size_t axis = std::abs(n[0]) <= 0.9 ? 0 : 1;
    Point t;
    for (std::size_t i = 0; i < 3; ++i) t[i] = (i == axis ? 1.0 : 0.0) - n[axis] * n[i];
    const double norm = std::hypot(t[0], t[1], t[2]);
    for (double& component : t) component /= norm;
    const double rows[] = {n[0], n[1], n[2], t[0], t[1], t[2], n[1] * t[2] - n[2] * t[1], n[2] * t[0] - n[0] * t[2],
                           n[0] * t[1] - n[1] * t[0]};
    std::copy(std::begin(rows), std::end(rows), frame);
}

// A face as pairs: walked from its smallest pair (edges: from their first corner on), so that neither weights nor order
// depend on how the host numbered its cells.
struct PairFace {
    std::vector<std::int64_t> pair;  // corners, then mid-sides
    std::size_t corners;
    bool operator<(const PairFace& other) const { return pair < other.pair; }
};

PairFace pair_face(const BoundaryFace& face, const std::map<std::int64_t, std::int64_t>& index) {
    PairFace result{{}, face.corner().size()};
    for (const std::int64_t node : face.all()) result.pair.push_back(index.at(node));
    if (result.corners == 2) return result;
    const auto first = result.pair.begin();
    const auto middle = first + static_cast<std::ptrdiff_t>(result.corners);
    const auto turn = std::min_element(first, middle) - first;
    std::rotate(first, first + turn, middle);
    if (middle != result.pair.end()) std::rotate(middle, middle + turn, result.pair.end());
    return result;
}

// The face in the list of an interface whose largest faces have more corners: the last corner is repeated, and where
// there is no mid-side node, the corner before it stands in.
void append_padded(const PairFace& face, std::size_t corners, std::size_t nodes, std::vector<std::int64_t>& out) {
    const std::size_t own = face.corners;
    for (std::size_t k = 0; k < corners; ++k) out.push_back(face.pair[std::min(k, own - 1)]);
    for (std::size_t side = 0; side < nodes - corners; ++side) {
        const std::size_t mine = side + 1 == corners ? own - 1 : side;  // the last side closes either polygon
        const bool there = own + mine < face.pair.size() && (side + 1 < own || side + 1 == corners);
        out.push_back(there ? face.pair[own + mine] : face.pair[std::min(side, own - 1)]);
    }
}

InterfaceGeometry geometry(const Mesh& mesh, const Matching& m, double distance) {
    InterfaceGeometry result;
    std::map<std::int64_t, std::int64_t> index;  // pair of a node of a
    for (const std::size_t i : spatial_order(mesh, m.node, distance)) {
        index.emplace(m.node[i].first, result.pair_count());
        result.node_a.push_back(m.node[i].first);
        result.node_b.push_back(m.node[i].second);
    }
    std::size_t corners = 2;
    bool quadratic = false;
    std::vector<PairFace> faces;
    for (const BoundaryFace& face : m.on_a) {
        corners = std::max(corners, face.corner().size());
        quadratic = quadratic || !face.middle().empty();
        faces.push_back(pair_face(face, index));
    }
    std::sort(faces.begin(), faces.end());
    const std::size_t nodes_per_face = !quadratic ? corners : corners == 2 ? 3 : 2 * corners;
    result.nodes_per_face = static_cast<int>(nodes_per_face);

    const auto dim = at(mesh.dimension());
    result.weight.assign(result.node_a.size(), 0.0);
    std::vector<Point> area(result.node_a.size(), Point{});
    for (const PairFace& face : faces) {
        std::array<std::int64_t, most_face_nodes> nodes{};
        for (std::size_t k = 0; k < face.pair.size(); ++k) nodes[k] = result.node_a[at(face.pair[k])];
        const NodalRule rule = nodal_rule(mesh, std::span<const std::int64_t>(nodes).first(face.pair.size()));
        for (std::size_t k = 0; k < face.pair.size(); ++k) {
            result.weight[at(face.pair[k])] += rule.weight[k];
            for (std::size_t i = 0; i < 3; ++i) area[at(face.pair[k])][i] += rule.area[k][i];
        }
        append_padded(face, corners, nodes_per_face, result.face);
    }
    result.frame.resize(result.node_a.size() * dim * dim);
    for (std::size_t p = 0; p < result.node_a.size(); ++p) {
        if (!(std::hypot(area[p][0], area[p][1], area[p][2]) > 1e-6 * result.weight[p]))
            fail(DELAM_ERROR_MESH, "the faces that meet at ", place(mesh, result.node_a[p]),
                 " look in opposite directions: no normal");
        write_frame(mesh.dimension(), area[p], &result.frame[p * dim * dim]);
    }
    return result;
}

}  // namespace

std::int64_t Mesh::add_interface(std::int32_t label_a, std::int32_t label_b, double tolerance) {
    const std::int32_t a = body_of_label(label_a);
    const std::int32_t b = body_of_label(label_b);
    if (a < 0) fail(DELAM_ERROR_ARGUMENT, "body_a ", label_a, ": no cell has this label");
    if (b < 0) fail(DELAM_ERROR_ARGUMENT, "body_b ", label_b, ": no cell has this label");
    if (a == b) fail(DELAM_ERROR_ARGUMENT, "body_a and body_b are both ", label_a, ": an interface joins two bodies");
    if (!(tolerance >= 0.0 && tolerance < 0.5))
        fail(DELAM_ERROR_ARGUMENT, "tolerance ", tolerance, ": must be in [0, 0.5)");
    for (std::size_t i = 0; i < interfaces_.size(); ++i)
        if (std::minmax(interfaces_[i].body_a, interfaces_[i].body_b) == std::minmax(a, b))
            fail(DELAM_ERROR_ARGUMENT, "bodies ", label_a, " and ", label_b, " are joined by interface ", i,
                 " already");

    const double edge = std::min(shortest_edge(*this, a), shortest_edge(*this, b));
    const double distance = (tolerance > 0.0 ? tolerance : 1e-6) * edge;
    const std::vector<BoundaryFace> faces_a = boundary_faces(*this, a);
    const std::vector<BoundaryFace> faces_b = boundary_faces(*this, b);
    const std::vector<std::int64_t> nodes_a = distinct_nodes(faces_a);
    const std::vector<std::int64_t> nodes_b = distinct_nodes(faces_b);
    const Matching m = match_boundaries(*this, faces_a, faces_b, match_nodes(*this, nodes_a, nodes_b, distance));

    const auto [left_a, left_b] = find_overlap(*this, m.left_a, m.left_b, distance);
    if (left_a >= 0) {
        const BoundaryFace& face_a = m.left_a[at(left_a)];
        const BoundaryFace& face_b = m.left_b[at(left_b)];
        fail(DELAM_ERROR_MESH, "bodies ", label_a, " and ", label_b, ": a face of cell ", face_b.cell,
             " with a corner at ", place(*this, face_b.node[0]), " lies on a face of cell ", face_a.cell,
             " with a corner at ", place(*this, face_a.node[0]), ", but their nodes do not match within ", distance);
    }
    if (m.on_a.empty()) {
        const BoxTree tree = tree_of(*this, nodes_a);
        std::pair nearest{std::numeric_limits<double>::infinity(), std::int64_t{-1}};
        for (const std::int64_t node : nodes_b)
            nearest = std::min(nearest, {tree.nearest(position(*this, node), nearest.first).distance, node});
        fail(DELAM_ERROR_MESH, "bodies ", label_a, " and ", label_b,
             ": no boundary faces coincide; their boundary nodes come as close as ", nearest.first, " (node ",
             nearest.second, "), faces count as one within ", distance);
    }
    InterfaceGeometry result = geometry(*this, m, distance);
    result.body_a = a;
    result.body_b = b;
    interfaces_.push_back(std::move(result));
    return static_cast<std::int64_t>(interfaces_.size()) - 1;
}

}  // namespace delam
