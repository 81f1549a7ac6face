// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/pairing/assemble_interface.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "mesh/faces.hpp"
#include "mesh/pairing/interfaces.hpp"
#include "mesh/points.hpp"
#include "mesh/rule/mid_sides.hpp"
#include "mesh/rule/nodal_rule.hpp"

namespace delam {

namespace {

// Orders positions by x, then y, then z, where coordinates closer than `distance` count as equal, so that rounding of
// the nodes of a straight interface does not change their order.
std::vector<std::size_t> spatial_order(const Mesh& mesh, std::span<const NodePair> pairs, FaceSide side,
                                       double distance) {
    std::vector<std::size_t> order(pairs.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::vector<std::array<std::int64_t, 3>> rank(pairs.size(), {0, 0, 0});
    for (std::size_t axis = 0; axis < index(mesh.dimension()); ++axis) {
        const auto x = [&](std::size_t i) {
            return mesh.node(side == FaceSide::a ? pairs[i].first : pairs[i].second)[axis];
        };
        std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return x(i) < x(j); });
        for (std::size_t k = 1; k < order.size(); ++k)
            rank[order[k]][axis] = rank[order[k - 1]][axis] + (x(order[k]) - x(order[k - 1]) > distance ? 1 : 0);
    }
    std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
        return std::pair(rank[i], pairs[i].first) < std::pair(rank[j], pairs[j].first);
    });
    return order;
}

// Returns a face in terms of pairs, beginning at its smallest pair (edges: at their first corner), so that neither
// weights nor order depend on the host's numbering of its cells.
struct PairFace {
    std::vector<std::int64_t> pair;  // corners, then mid-sides, then the centre
    std::size_t corners;
    bool operator<(const PairFace& other) const { return pair < other.pair; }
};

// pairs: of the face's nodes.
PairFace pair_face(const BoundaryFace& face, std::span<const std::int64_t> pairs) {
    PairFace result{{pairs.begin(), pairs.end()}, face.corner().size()};
    if (result.corners == 2) return result;
    const auto first = result.pair.begin();
    const auto corners = static_cast<std::ptrdiff_t>(result.corners);
    const auto middle = first + corners;
    const auto turn = std::min_element(first, middle) - first;
    std::rotate(first, first + turn, middle);
    if (middle != result.pair.end()) std::rotate(middle, middle + turn, middle + corners);
    return result;
}

// Appends the face as one of the kind `row`, that of the largest faces of the interface. Its last corner is repeated if
// it has fewer corners; a corner replaces a missing mid-side node, and the first mid-side node replaces a missing
// centre. The pieces of the larger face then cover the smaller one.
void append_padded(const PairFace& face, const FaceRow& row, std::vector<std::int64_t>& out) {
    const std::size_t own = face.corners, corners = index(row.corners), sides = index(row.sides());
    const std::size_t own_sides = own == 2 ? 1 : own;
    const std::size_t start = out.size();
    for (std::size_t k = 0; k < corners; ++k) out.push_back(face.pair[std::min(k, own - 1)]);
    for (std::size_t side = 0; corners + side < index(row.nodes); ++side) {
        if (side >= sides) {
            const std::size_t centre = own + own_sides + (side - sides);
            out.push_back(centre < face.pair.size() ? face.pair[centre] : out[start + corners]);
            continue;
        }
        const std::size_t mine = side + 1 == corners ? own - 1 : side;  // the last side closes either polygon
        const bool there = own + mine < face.pair.size() && (side + 1 < own || side + 1 == corners);
        out.push_back(there ? face.pair[own + mine] : face.pair[std::min(side, own - 1)]);
    }
}

}  // namespace

// In the plane the tangent is the normal rotated clockwise. In space the first tangent is the x axis projected onto the
// face, or the y axis if the normal is close to x, and the second completes a right-handed frame.
void write_frame(int dimension, const Point& along, double* frame) {
    const double size = length(along);
    const Point n{along[0] / size, along[1] / size, along[2] / size};
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
    const double rows[] = {n[0],
                           n[1],
                           n[2],
                           t[0],
                           t[1],
                           t[2],
                           n[1] * t[2] - n[2] * t[1],
                           n[2] * t[0] - n[0] * t[2],
                           n[0] * t[1] - n[1] * t[0]};
    std::copy(std::begin(rows), std::end(rows), frame);
}

BoundaryFace turned(const BoundaryFace& face) {
    BoundaryFace result = face;
    const auto n = index(face.corners);
    for (std::size_t k = 0; k < n; ++k) result.node[k] = face.node[n - 1 - k];
    const std::size_t sides = std::min(face.middle().size(), n == 2 ? 1 : n);
    for (std::size_t k = 0; k < sides; ++k) result.node[n + k] = face.node[n + (2 * sides - 2 - k) % sides];
    return result;
}

namespace {

// The pairs of each face's nodes, -1 where a node has none.
using PairsOfFaces = std::vector<std::vector<std::int64_t>>;

// Sums up the rules of faces: weights, area vectors, and the area around each pair.
struct PairAreas {
    explicit PairAreas(std::size_t pairs) : weight(pairs, 0.0), around(pairs, 0.0), vector(pairs, Point{}) {}
    void add(std::span<const std::int64_t> of_face, const NodalRule& rule) {
        double whole = 0.0;
        for (std::size_t k = 0; k < of_face.size(); ++k) whole += rule.weight[k];
        for (std::size_t k = 0; k < of_face.size(); ++k) {
            if (of_face[k] < 0) continue;
            weight[index(of_face[k])] += rule.weight[k];
            around[index(of_face[k])] += whole;
            for (std::size_t i = 0; i < 3; ++i) vector[index(of_face[k])][i] += rule.area[k][i];
        }
    }
    std::vector<double> weight, around;
    std::vector<Point> vector;
};

// Says which values the pairs at mid-side nodes compare: those at the nodes, or values with positive weights that give
// a uniform traction its nodal forces (mid_sides.hpp).
enum class MidSideValues { nodal, consistent };

// The area vectors of pairs, and those at mid-side nodes that compare other values than these.
struct LaidPairs {
    std::vector<Point> area;
    std::vector<MidSide> middle;
};

// Fills weights and faces. nodes: of the pairs, on the side of the faces.
LaidPairs lay_pairs(const Mesh& mesh, std::span<const BoundaryFace> faces_of_nodes, const PairsOfFaces& pairs,
                    std::span<const std::int64_t> nodes, MidSideValues values, InterfaceGeometry& interface) {
    std::size_t corners = index(mesh.dimension()), others = 0;
    std::vector<PairFace> faces;
    std::vector<std::size_t> open;  // faces with a node that is no pair
    MidSides sides(nodes.size());
    for (std::size_t f = 0; f < faces_of_nodes.size(); ++f) {
        const BoundaryFace& face = faces_of_nodes[f];
        poll_cancel("pairs", 2);
        corners = std::max(corners, face.corner().size());
        others = std::max(others, face.middle().size());
        if (values == MidSideValues::consistent) sides.add(face.all(), pairs[f], face.corner().size());
        if (std::find(pairs[f].begin(), pairs[f].end(), -1) == pairs[f].end())
            faces.push_back(pair_face(face, pairs[f]));
        else
            open.push_back(f);
    }
    std::sort(faces.begin(), faces.end());
    const auto sum_up = [&] {
        PairAreas areas(nodes.size());
        const auto add = [&](std::span<const std::int64_t> face, std::span<const std::int64_t> own, std::size_t count) {
            poll_cancel("pairs", 2);
            areas.add(own,
                      values == MidSideValues::nodal ? nodal_rule(mesh, face) : sides.rule(mesh, face, own, count));
        };
        for (const std::size_t f : open) add(faces_of_nodes[f].all(), pairs[f], faces_of_nodes[f].corner().size());
        for (const PairFace& face : faces) {
            std::array<std::int64_t, most_face_nodes> own{};
            for (std::size_t k = 0; k < face.pair.size(); ++k) own[k] = nodes[index(face.pair[k])];
            add(std::span<const std::int64_t>(own).first(face.pair.size()), face.pair, face.corners);
        }
        return areas;
    };
    PairAreas areas = sum_up();
    while (sides.widen(areas.weight, areas.around)) areas = sum_up();
    interface.weight = std::move(areas.weight);

    const FaceRow& row = face_row(mesh.dimension(), corners, others);
    interface.nodes_per_face = row.nodes;
    for (const PairFace& face : faces) append_padded(face, row, interface.face);
    return {std::move(areas.vector), sides.list()};
}

// Makes the frames of an interface from the area vectors of its pairs.
void write_frames(const Mesh& mesh, const std::vector<Point>& area, std::span<const std::int64_t> nodes,
                  InterfaceGeometry& interface) {
    const auto dim = index(mesh.dimension());
    interface.frame.resize(nodes.size() * dim * dim);
    for (std::size_t p = 0; p < nodes.size(); ++p) {
        if (!(length(area[p]) > 1e-6 * interface.weight[p]))
            fail(DELAM_ERROR_MESH, "the faces that meet at ", place(mesh, nodes[p]),
                 " have opposite normals: the normal of the interface is not defined");
        write_frame(mesh.dimension(), area[p], &interface.frame[p * dim * dim]);
    }
}

LaidPairs lay_faces_with(const Mesh& mesh, std::span<const BoundaryFace> faces, FaceSide side, MidSideValues values,
                         InterfaceGeometry& interface) {
    const std::vector<std::int64_t>& nodes = side == FaceSide::a ? interface.node_a : interface.node_b;
    std::map<std::int64_t, std::int64_t> pair_of;  // pair of a node of the faces
    for (std::size_t p = 0; p < nodes.size(); ++p) pair_of.emplace(nodes[p], static_cast<std::int64_t>(p));
    PairsOfFaces pairs;
    for (const BoundaryFace& face : faces) {
        pairs.emplace_back();
        for (const std::int64_t node : face.all()) pairs.back().push_back(pair_of.at(node));
    }
    return lay_pairs(mesh, faces, pairs, nodes, values, interface);
}

}  // namespace

void lay_faces(const Mesh& mesh, std::span<const BoundaryFace> faces, FaceSide side, InterfaceGeometry& interface) {
    lay_faces_with(mesh, faces, side, MidSideValues::nodal, interface);
}

NewInterface assemble_interface(const Mesh& mesh, std::span<const NodePair> pairs, std::span<const BoundaryFace> faces,
                                FaceSide side, double distance) {
    NewInterface result;
    for (const std::size_t i : spatial_order(mesh, pairs, side, distance)) {
        result.geometry.node_a.push_back(pairs[i].first);
        result.geometry.node_b.push_back(pairs[i].second);
    }
    LaidPairs laid = lay_faces_with(mesh, faces, side, MidSideValues::consistent, result.geometry);
    write_frames(mesh, laid.area, side == FaceSide::a ? result.geometry.node_a : result.geometry.node_b,
                 result.geometry);
    result.middle = std::move(laid.middle);
    return result;
}

NewInterface assemble_interface(const Mesh& mesh, std::span<const NodePair> pairs, std::span<const BoundaryFace> faces,
                                std::span<const std::vector<NodePair>> of_faces, double distance) {
    NewInterface result;
    InterfaceGeometry& made = result.geometry;
    std::map<NodePair, std::int64_t> place_of;
    for (const std::size_t i : spatial_order(mesh, pairs, FaceSide::a, distance)) {
        place_of.emplace(pairs[i], static_cast<std::int64_t>(made.node_a.size()));
        made.node_a.push_back(pairs[i].first);
        made.node_b.push_back(pairs[i].second);
    }
    PairsOfFaces known;
    for (const std::vector<NodePair>& of_face : of_faces) {
        known.emplace_back();
        for (const NodePair& pair : of_face) known.back().push_back(pair.first == pair.second ? -1 : place_of.at(pair));
    }
    LaidPairs laid = lay_pairs(mesh, faces, known, made.node_a, MidSideValues::consistent, made);
    write_frames(mesh, laid.area, made.node_a, made);
    result.middle = std::move(laid.middle);
    return result;
}

namespace {

// Part of a direction that must lie in the face: what is left of a direction with 16 digits then has 10 of them.
constexpr double least_part = 1e-6;

}  // namespace

void set_tangents(Mesh& mesh, std::int64_t interface, std::span<const double> directions) {
    const InterfaceGeometry& geometry = mesh.interfaces()[index(interface)];
    std::vector<double> frames = geometry.frame;
    for (std::size_t p = 0; p < geometry.weight.size(); ++p) {
        const std::span<const double> given = directions.size() == 3 ? directions : directions.subspan(3 * p, 3);
        const double size = std::hypot(given[0], given[1], given[2]);
        const Point along{given[0] / size, given[1] / size, given[2] / size};
        double* rows = &frames[9 * p];
        const Point n{rows[0], rows[1], rows[2]};
        const double across = dot(along, n);
        const Point t{along[0] - across * n[0], along[1] - across * n[1], along[2] - across * n[2]};
        const double part = length(t);
        if (!(part > least_part))
            fail(DELAM_ERROR_MESH, "directions: (", given[0], ", ", given[1], ", ", given[2], ") of pair ", p, " at ",
                 place(mesh, geometry.node_b[p]), " is the normal there: a direction along the interface is expected");
        const Point first{t[0] / part, t[1] / part, t[2] / part}, second = cross(n, first);
        std::copy(first.begin(), first.end(), rows + 3);
        std::copy(second.begin(), second.end(), rows + 6);
    }
    turn_frames(mesh, index(interface), std::move(frames));
}

Point require_normal(int dimension, std::span<const double> normals, std::size_t pair) {
    const std::size_t dim = index(dimension);
    Point normal{};
    for (std::size_t i = 0; i < dim; ++i) {
        normal[i] = normals[pair * dim + i];
        if (!std::isfinite(normal[i]))
            fail(DELAM_ERROR_ARGUMENT, "normals[", pair, "][", i, "] = ", normal[i], " is not finite");
    }
    if (!(length(normal) > 0.0)) fail(DELAM_ERROR_ARGUMENT, "normals[", pair, "] has length 0");
    return normal;
}

void require_weight(std::span<const double> weights, std::size_t pair) {
    if (!(weights[pair] > 0.0 && std::isfinite(weights[pair])))
        fail(DELAM_ERROR_ARGUMENT, "weights[", pair, "] = ", weights[pair], ": must be > 0 and finite");
}

}  // namespace delam
