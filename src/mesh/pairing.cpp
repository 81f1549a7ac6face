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
#include "mesh/overlap.hpp"
#include "mesh/shape.hpp"

namespace delam {

namespace {

std::span<const std::int64_t> nodes_of(const BoundaryFace& face) { return std::span(face.node).first(at(face.nodes)); }

Point position(const Mesh& mesh, std::int64_t node) {
    Point p{};
    std::copy(mesh.node(node).begin(), mesh.node(node).end(), p.begin());
    return p;
}

std::string place(const Mesh& mesh, std::int64_t node) {
    const auto p = mesh.node(node);
    return p.size() == 2 ? text("(", p[0], ", ", p[1], ")") : text("(", p[0], ", ", p[1], ", ", p[2], ")");
}

double shortest_edge(const Mesh& mesh, std::int32_t body) {
    double shortest = std::numeric_limits<double>::infinity();
    for (const std::int64_t c : mesh.body_cells(body)) {
        const CellTopology& shape = topology(mesh.cell_type(c));
        for (std::size_t f = 0; f < at(shape.faces); ++f) {
            for (std::size_t k = 0; k < at(shape.face_nodes); ++k) {
                const int next = shape.face[f][(k + 1) % at(shape.face_nodes)];
                const Point p = position(mesh, mesh.cell(c)[at(shape.face[f][k])]);
                const Point q = position(mesh, mesh.cell(c)[at(next)]);
                shortest = std::min(shortest, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
            }
        }
    }
    return shortest;
}

std::vector<std::int64_t> distinct_nodes(std::span<const BoundaryFace> faces) {
    std::vector<std::int64_t> nodes;
    for (const BoundaryFace& face : faces) nodes.insert(nodes.end(), nodes_of(face).begin(), nodes_of(face).end());
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

Matching match_boundaries(const Mesh& mesh, std::span<const BoundaryFace> faces_a,
                          std::span<const BoundaryFace> faces_b, std::span<const std::int64_t> partner) {
    std::vector<std::pair<FaceKey, std::size_t>> known;
    known.reserve(faces_a.size());
    for (std::size_t f = 0; f < faces_a.size(); ++f) known.emplace_back(sorted_key(nodes_of(faces_a[f])), f);
    std::sort(known.begin(), known.end());

    Matching m;
    std::vector<char> used(faces_a.size(), 0);
    for (const BoundaryFace& face : faces_b) {
        std::array<std::int64_t, 4> image{};
        bool complete = true;
        for (std::size_t k = 0; k < at(face.nodes); ++k) {
            image[k] = partner[at(face.node[k])];
            complete = complete && image[k] >= 0;
        }
        const FaceKey key = sorted_key(std::span(image).first(at(face.nodes)));
        const auto found = std::lower_bound(known.begin(), known.end(), std::pair(key, std::size_t{0}));
        if (!complete || found == known.end() || found->first != key) {
            m.left_b.push_back(face);
            continue;
        }
        const BoundaryFace& other = faces_a[found->second];
        if (dot(area_vector(mesh, nodes_of(face)), area_vector(mesh, nodes_of(other))) >= 0.0)
            fail(DELAM_ERROR_MESH, "cells ", other.cell, " and ", face.cell, " of the two bodies lie on the same side ",
                 "of the face they share at ", place(mesh, face.node[0]), ": the bodies overlap");
        used[found->second] = 1;
        for (std::size_t k = 0; k < at(face.nodes); ++k) m.node.emplace_back(image[k], face.node[k]);
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

// Integrals of the nodal shape functions over a face: the trapezoid on edges, a third each on triangles; on
// quadrilaterals, by 2 x 2 Gauss points at which all N_a are positive,
//     w_a = int N_a |x_xi x x_eta| dxi deta.
std::array<double, 4> vertex_weights(const Mesh& mesh, std::span<const std::int64_t> nodes) {
    std::array<double, 4> weights{};
    if (nodes.size() != 4) {
        const Point area = area_vector(mesh, nodes);
        const auto count = static_cast<double>(nodes.size());
        std::fill_n(weights.begin(), nodes.size(), std::hypot(area[0], area[1], area[2]) / count);
        return weights;
    }
    const Quadrature gauss = quadrature(CellType::quad4);
    const auto corner = corners(CellType::quad4);
    for (const ReferencePoint& p : gauss.points) {
        const ShapeGradient g = reference_gradient(CellType::quad4, p);
        Point u{};
        Point v{};
        for (std::size_t a = 0; a < 4; ++a) {
            for (std::size_t i = 0; i < 3; ++i) {
                const double x = mesh.node(nodes[a])[i] - mesh.node(nodes[0])[i];
                u[i] += g[2 * a] * x;
                v[i] += g[2 * a + 1] * x;
            }
        }
        const double area = std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
        for (std::size_t a = 0; a < 4; ++a)
            weights[a] += gauss.weight * area * 0.25 * (1.0 + corner[a][0] * p[0]) * (1.0 + corner[a][1] * p[1]);
    }
    return weights;
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

InterfaceGeometry geometry(const Mesh& mesh, const Matching& m, double distance) {
    InterfaceGeometry result;
    std::map<std::int64_t, std::int64_t> index;  // pair of a node of a
    for (const std::size_t i : spatial_order(mesh, m.node, distance)) {
        index.emplace(m.node[i].first, result.pair_count());
        result.node_a.push_back(m.node[i].first);
        result.node_b.push_back(m.node[i].second);
    }
    for (const BoundaryFace& face : m.on_a) result.nodes_per_face = std::max(result.nodes_per_face, face.nodes);

    // Faces by their pairs, so that neither weights nor order depend on how the host numbered its cells.
    std::vector<std::vector<std::int64_t>> faces;
    for (const BoundaryFace& face : m.on_a) {
        std::vector<std::int64_t> pairs;
        for (const std::int64_t node : nodes_of(face)) pairs.push_back(index.at(node));
        if (face.nodes > 2) std::rotate(pairs.begin(), std::min_element(pairs.begin(), pairs.end()), pairs.end());
        faces.push_back(std::move(pairs));
    }
    std::sort(faces.begin(), faces.end());

    const auto dim = at(mesh.dimension());
    result.weight.assign(result.node_a.size(), 0.0);
    std::vector<Point> area(result.node_a.size(), Point{});
    for (const std::vector<std::int64_t>& pairs : faces) {
        std::array<std::int64_t, 4> nodes{};
        for (std::size_t k = 0; k < pairs.size(); ++k) nodes[k] = result.node_a[at(pairs[k])];
        const auto face = std::span<const std::int64_t>(nodes).first(pairs.size());
        const std::array<double, 4> weights = vertex_weights(mesh, face);
        const Point vector = area_vector(mesh, face);
        for (std::size_t k = 0; k < pairs.size(); ++k) {
            result.weight[at(pairs[k])] += weights[k];
            for (std::size_t i = 0; i < 3; ++i) area[at(pairs[k])][i] += vector[i];
        }
        for (std::size_t k = 0; k < at(result.nodes_per_face); ++k)
            result.face.push_back(pairs[std::min(k, pairs.size() - 1)]);
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
