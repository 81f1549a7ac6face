// SPDX-License-Identifier: BSD-3-Clause
//
// Forms an interface of two bodies: their boundary nodes are matched by position, then their boundary faces through the
// nodes, and area and normal of the faces give the weights and frames of the node pairs.
#include <algorithm>
#include <iterator>
#include <limits>
#include <set>
#include <utility>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "delam/delam.h"
#include "mesh/box_tree.hpp"
#include "mesh/faces.hpp"
#include "mesh/mesh.hpp"
#include "mesh/pairing/assemble_interface.hpp"
#include "mesh/pairing/interfaces.hpp"
#include "mesh/pairing/overlap.hpp"
#include "mesh/points.hpp"
#include "mesh/rule/mid_sides.hpp"

namespace delam {

namespace {

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

// Nodes of b with the coinciding node of a, ascending. Its size is that of the two lists of nodes, not of the mesh: a
// mesh may have thousands of small interfaces.
class Partners {
public:
    Partners(const Mesh& mesh, std::span<const std::int64_t> a, std::span<const std::int64_t> b, double distance) {
        const BoxTree tree = tree_of(mesh, a);
        for (const std::int64_t node : b) {
            poll_cancel("pairs");
            if (const auto found = tree.nearest(position(mesh, node), distance); found.index >= 0)
                list_.emplace_back(node, a[index(found.index)]);
        }
    }
    // -1: none.
    std::int64_t of(std::int64_t node) const {
        const auto found = std::lower_bound(list_.begin(), list_.end(), std::pair(node, std::int64_t{-1}));
        return found == list_.end() || found->first != node ? -1 : found->second;
    }

private:
    std::vector<std::pair<std::int64_t, std::int64_t>> list_;
};

using FaceKey = std::array<std::int64_t, 4>;
FaceKey sorted_key(std::span<const std::int64_t> nodes) {
    FaceKey key;
    key.fill(std::numeric_limits<std::int64_t>::max());
    std::copy(nodes.begin(), nodes.end(), key.begin());
    std::sort(key.begin(), key.end());
    return key;
}

struct Matching {
    std::vector<BoundaryFace> on_a;            // matched faces, as in body a
    std::vector<NodePair> node;                // matched nodes, ascending
    std::vector<BoundaryFace> left_a, left_b;  // faces without a match
};

// Two faces with coinciding corners are one face. A mid-side node of either without a partner is an error, reported
// here because such faces otherwise match.
void require_same_middle(const Mesh& mesh, const BoundaryFace& a, const BoundaryFace& b, const Partners& partner) {
    std::vector<std::int64_t> met;
    const auto refuse = [&](std::int64_t node) {
        fail(DELAM_ERROR_MESH, "the face that cells ", a.cell, " and ", b.cell, " of the two bodies share at ",
             place(mesh, a.node[0]), ": mid-side node ", node, " at ", place(mesh, node),
             " has no partner on the other side: the nodes do not match");
    };
    for (const std::int64_t node : b.middle()) {
        const std::int64_t image = partner.of(node);
        if (std::find(a.middle().begin(), a.middle().end(), image) == a.middle().end()) refuse(node);
        met.push_back(image);
    }
    for (const std::int64_t node : a.middle())
        if (std::find(met.begin(), met.end(), node) == met.end()) refuse(node);
}

// Faces are found by their corners.
Matching match_boundaries(const Mesh& mesh, std::span<const BoundaryFace> faces_a,
                          std::span<const BoundaryFace> faces_b, const Partners& partner) {
    std::vector<std::pair<FaceKey, std::size_t>> known;
    known.reserve(faces_a.size());
    for (std::size_t f = 0; f < faces_a.size(); ++f) known.emplace_back(sorted_key(faces_a[f].corner()), f);
    std::sort(known.begin(), known.end());

    Matching m;
    std::vector<char> used(faces_a.size(), 0);
    for (const BoundaryFace& face : faces_b) {
        poll_cancel("pairs");
        std::array<std::int64_t, 4> image{};
        bool complete = true;
        for (std::size_t k = 0; k < face.corner().size(); ++k) {
            image[k] = partner.of(face.node[k]);
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
        for (const std::int64_t node : face.all()) m.node.emplace_back(partner.of(node), node);
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

// The common faces of two bodies within a distance; empty if no face of one is a face of the other. Faces that overlap
// otherwise are refused.
Matching match_bodies(const Mesh& mesh, std::span<const BoundaryFace> faces_a, std::span<const BoundaryFace> faces_b,
                      double distance) {
    const Partners partner(mesh, distinct_nodes(faces_a), distinct_nodes(faces_b), distance);
    Matching m = match_boundaries(mesh, faces_a, faces_b, partner);
    const auto [left_a, left_b] = find_overlap(mesh, m.left_a, m.left_b, distance);
    if (left_a >= 0) {
        const BoundaryFace& face_a = m.left_a[index(left_a)];
        const BoundaryFace& face_b = m.left_b[index(left_b)];
        const auto label = [&](const BoundaryFace& face) { return mesh.body_label(mesh.cell_body(face.cell)); };
        fail(DELAM_ERROR_MESH, "bodies ", label(face_a), " and ", label(face_b), ": a face of cell ", face_b.cell,
             " with a corner at ", place(mesh, face_b.node[0]), " lies on a face of cell ", face_a.cell,
             " with a corner at ", place(mesh, face_a.node[0]), ", but their nodes do not match within ", distance);
    }
    return m;
}

NewInterface interface_of(const Mesh& mesh, const Matching& m, std::int32_t a, std::int32_t b, double distance) {
    NewInterface result = assemble_interface(mesh, m.node, m.on_a, FaceSide::a, distance);
    result.geometry.body_a = a;
    result.geometry.body_b = b;
    return result;
}

double relative(double tolerance) { return tolerance > 0.0 ? tolerance : 1e-6; }

void require_tolerance(double tolerance) {
    if (!(tolerance >= 0.0 && tolerance < 0.5))
        fail(DELAM_ERROR_ARGUMENT, "tolerance ", tolerance, ": must be in [0, 0.5)");
}

// Data of each body for the search for touching bodies.
struct Skin {
    double edge = std::numeric_limits<double>::infinity();
    std::vector<std::size_t> faces;
};

}  // namespace

std::pair<std::int32_t, std::int32_t> require_unjoined(const Mesh& mesh, std::int32_t label_a, std::int32_t label_b) {
    const std::int32_t a = mesh.body_of_label(label_a);
    const std::int32_t b = mesh.body_of_label(label_b);
    if (a < 0) fail(DELAM_ERROR_ARGUMENT, "body_a ", label_a, ": no body has this label");
    if (b < 0) fail(DELAM_ERROR_ARGUMENT, "body_b ", label_b, ": no body has this label");
    if (a == b)
        fail(DELAM_ERROR_ARGUMENT, "body_a and body_b are both ", label_a, ": an interface joins two different bodies");
    for (std::size_t i = 0; i < mesh.interfaces().size(); ++i)
        if (std::minmax(mesh.interfaces()[i].body_a, mesh.interfaces()[i].body_b) == std::minmax(a, b))
            fail(DELAM_ERROR_ARGUMENT, "bodies ", label_a, " and ", label_b, " are already joined by interface ", i);
    return {a, b};
}

void require_cells(const Mesh& mesh, std::int32_t body) {
    if (mesh.host_body(body))
        fail(DELAM_ERROR_MESH, "body ", mesh.body_label(body),
             " has no cells and so no faces: give its pairs (delam_mesh_add_pairs)");
}

std::int64_t add_interface(Mesh& mesh, std::int32_t label_a, std::int32_t label_b, double tolerance) {
    const auto [a, b] = require_unjoined(mesh, label_a, label_b);
    require_cells(mesh, a);
    require_cells(mesh, b);
    require_tolerance(tolerance);
    const double edge = std::min(shortest_edge(mesh, mesh.body_cells(a)), shortest_edge(mesh, mesh.body_cells(b)));
    const double distance = relative(tolerance) * edge;
    const std::vector<BoundaryFace> faces_a = boundary_faces(mesh, a);
    const std::vector<BoundaryFace> faces_b = boundary_faces(mesh, b);
    const Matching m = match_bodies(mesh, faces_a, faces_b, distance);
    if (m.on_a.empty()) {
        const BoxTree tree = tree_of(mesh, distinct_nodes(faces_a));
        std::pair nearest{std::numeric_limits<double>::infinity(), std::int64_t{-1}};
        for (const std::int64_t node : distinct_nodes(faces_b))
            nearest = std::min(nearest, {tree.nearest(position(mesh, node), nearest.first).distance, node});
        fail(DELAM_ERROR_MESH, "bodies ", label_a, " and ", label_b,
             ": no boundary faces coincide; their boundary nodes come as close as ", nearest.first, " (node ",
             nearest.second, "), faces coincide within ", distance);
    }
    return append_interface(mesh, interface_of(mesh, m, a, b, distance));
}

// Two bodies can share a face only where boxes around their boundary faces meet, and only the faces with such boxes are
// matched. The effort therefore grows with the number of faces, whatever the number of bodies.
std::int64_t add_all_interfaces(Mesh& mesh, double tolerance) {
    require_tolerance(tolerance);
    std::vector<Skin> skins(index(mesh.body_count()));
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c) {
        double& edge = skins[index(mesh.cell_body(c))].edge;
        edge = std::min(edge, shortest_edge(mesh, std::span(&c, 1)));
    }
    const std::vector<BoundaryFace> faces = boundary_faces(mesh, -1);
    std::vector<std::int32_t> body(faces.size());
    std::vector<Box> boxes(faces.size());
    for (std::size_t f = 0; f < faces.size(); ++f) {
        body[f] = mesh.cell_body(faces[f].cell);
        boxes[f] = box_of(mesh, faces[f], relative(tolerance) * skins[index(body[f])].edge);
    }
    const BoxTree tree(boxes);
    struct Meeting {
        std::int32_t a, b;
        std::size_t on_a, on_b;
    };
    std::vector<Meeting> meetings;
    for (std::size_t f = 0; f < faces.size(); ++f) {
        poll_cancel("pairs", 2);
        tree.meeting(boxes[f], [&](std::int64_t g) {
            if (body[f] < body[index(g)]) meetings.push_back({body[f], body[index(g)], f, index(g)});
        });
    }
    std::sort(meetings.begin(), meetings.end(),
              [](const Meeting& x, const Meeting& y) { return std::pair(x.a, x.b) < std::pair(y.a, y.b); });

    std::set<std::pair<std::int32_t, std::int32_t>> joined;
    for (const InterfaceGeometry& i : mesh.interfaces())
        joined.insert(std::minmax(i.body_a, i.body_b));  // obstacles have no such pair of bodies
    const auto those = [&](std::vector<std::size_t> list) {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
        std::vector<BoundaryFace> picked;
        for (const std::size_t f : list) picked.push_back(faces[f]);
        return picked;
    };
    std::vector<NewInterface> found;
    for (std::size_t k = 0; k < meetings.size();) {
        const auto [a, b, first_a, first_b] = meetings[k];
        std::vector<std::size_t> on_a;
        std::vector<std::size_t> on_b;
        for (; k < meetings.size() && meetings[k].a == a && meetings[k].b == b; ++k) {
            on_a.push_back(meetings[k].on_a);
            on_b.push_back(meetings[k].on_b);
        }
        if (joined.contains({a, b})) continue;
        const double distance = relative(tolerance) * std::min(skins[index(a)].edge, skins[index(b)].edge);
        const Matching m = match_bodies(mesh, those(std::move(on_a)), those(std::move(on_b)), distance);
        if (!m.on_a.empty()) found.push_back(interface_of(mesh, m, a, b, distance));
    }
    const auto count = static_cast<std::int64_t>(found.size());
    append_interfaces(mesh, std::move(found));
    return count;
}

}  // namespace delam
