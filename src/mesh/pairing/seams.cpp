// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/pairing/seams.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "mesh/face_point.hpp"
#include "mesh/faces.hpp"
#include "mesh/pairing/assemble_interface.hpp"
#include "mesh/pairing/interfaces.hpp"
#include "mesh/pairing/mortar_interface.hpp"
#include "mesh/points.hpp"
#include "mesh/rule/mid_sides.hpp"

namespace delam {

namespace {

// True at nodes that have a pair, by themselves or through nodes tied to them.
std::vector<std::uint8_t> paired_nodes(const Mesh& mesh) {
    std::vector<std::uint8_t> paired(index(mesh.node_count()), 0);
    for (const InterfaceGeometry& interface : mesh.interfaces()) {
        for (const std::int64_t node : interface.node_a) paired[index(node)] = 1;
        for (const std::int64_t node : interface.node_b) paired[index(node)] = 1;
    }
    for (const NodeTie& tie : mesh.ties())
        for (const auto& [node, weight] : tie.of) paired[index(node)] = 1;
    return paired;
}

Point centre_of(const Mesh& mesh, const BoundaryFace& face) {
    Point centre{};
    for (const std::int64_t node : face.corner())
        for (std::size_t i = 0; i < index(mesh.dimension()); ++i)
            centre[i] += mesh.node(node)[i] / static_cast<double>(face.corners);
    return centre;
}

// Node of the lowest number at the place of each node of some faces.
std::map<std::int64_t, std::int64_t> places_of(const Mesh& mesh, std::span<const BoundaryFace> faces, double distance) {
    std::vector<std::int64_t> nodes;
    for (const BoundaryFace& face : faces) nodes.insert(nodes.end(), face.all().begin(), face.all().end());
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    std::vector<Box> boxes;
    for (const std::int64_t node : nodes) boxes.push_back({position(mesh, node), position(mesh, node)});
    const BoxTree tree(boxes);
    std::map<std::int64_t, std::int64_t> place;
    for (const std::int64_t node : nodes) {
        poll_cancel("pairs");
        Box around{position(mesh, node), position(mesh, node)};
        for (std::size_t i = 0; i < 3; ++i) around.low[i] -= distance, around.high[i] += distance;
        std::int64_t lowest = node;
        tree.meeting(around, [&](std::int64_t other) {
            if (length(position(mesh, nodes[index(other)]) - position(mesh, node)) <= distance)
                lowest = std::min(lowest, nodes[index(other)]);
        });
        const auto known = place.find(lowest);
        place.emplace(node, known == place.end() ? lowest : known->second);
    }
    return place;
}

// Two faces of a body that lie on each other, with the nodes of one beside those of the other.
struct Facing {
    BoundaryFace face, other;
    std::vector<NodePair> pairs;  // of all nodes, the same node twice where both faces have it
};

Facing turned_over(const Facing& facing) {
    Facing result{facing.other, facing.face, {}};
    for (const auto& [a, b] : facing.pairs) result.pairs.emplace_back(b, a);
    return result;
}

// Returns the faces that lie on each other; refuses three or more at one place, and nodes without a partner.
std::vector<Facing> facing_faces(const Mesh& mesh, std::span<const BoundaryFace> faces, double distance) {
    const std::map<std::int64_t, std::int64_t> place_of = places_of(mesh, faces, distance);
    std::map<std::vector<std::int64_t>, std::vector<std::size_t>> at;
    for (std::size_t f = 0; f < faces.size(); ++f) {
        std::vector<std::int64_t> key;
        for (const std::int64_t node : faces[f].corner()) key.push_back(place_of.at(node));
        std::sort(key.begin(), key.end());
        at[key].push_back(f);
    }
    std::vector<Facing> found;
    for (const auto& [key, there] : at) {
        if (there.size() < 2) continue;
        const BoundaryFace &face = faces[there[0]], &other = faces[there[1]];
        if (there.size() > 2 || dot(area_vector(mesh, face.all()), area_vector(mesh, other.all())) >= 0.0)
            fail(DELAM_ERROR_MESH, "body ", mesh.body_label(mesh.cell_body(face.cell)), ": ", there.size(),
                 " outer faces lie on each other at ", place(mesh, face.node[0]),
                 ", expected two that face each other: the cells overlap");
        if (face.all().size() != other.all().size())
            fail(DELAM_ERROR_MESH, "cells ", face.cell, " and ", other.cell, " have faces at ",
                 place(mesh, face.node[0]), " with ", face.all().size(), " and ", other.all().size(),
                 " nodes: the nodes of the seam do not match");
        Facing& facing = found.emplace_back(Facing{face, other, {}});
        for (const std::int64_t node : face.all()) {
            const auto partner = std::find_if(other.all().begin(), other.all().end(),
                                              [&](std::int64_t n) { return place_of.at(n) == place_of.at(node); });
            if (partner == other.all().end())
                fail(DELAM_ERROR_MESH, "node ", node, " at ", place(mesh, node),
                     " has no partner on the other side of its seam: the nodes do not match");
            facing.pairs.emplace_back(node, *partner);
        }
    }
    return found;
}

// Returns the connected seams. The faces of one are turned so that those that have a pair in common have it the same
// way round; refuses a seam of one side (a Moebius strip).
std::vector<std::vector<Facing>> connected(const Mesh& mesh, std::vector<Facing> facing) {
    std::map<NodePair, std::vector<std::size_t>> of_pair;  // ascending nodes
    for (std::size_t f = 0; f < facing.size(); ++f)
        for (const auto& [a, b] : facing[f].pairs)
            if (a != b) of_pair[std::minmax(a, b)].push_back(f);
    std::vector<std::uint8_t> met(facing.size(), 0);
    std::vector<std::vector<Facing>> seams;
    for (std::size_t first = 0; first < facing.size(); ++first) {
        if (met[first] != 0) continue;
        std::vector<std::size_t> front{first};
        met[first] = 1;
        seams.emplace_back();
        while (!front.empty()) {
            const std::size_t f = front.back();
            front.pop_back();
            seams.back().push_back(facing[f]);
            for (const NodePair& pair : std::vector<NodePair>(facing[f].pairs)) {
                if (pair.first == pair.second) continue;
                for (const std::size_t other : of_pair.at(std::minmax(pair.first, pair.second))) {
                    const auto& there = facing[other].pairs;
                    const bool alike = std::find(there.begin(), there.end(), pair) != there.end();
                    if (met[other] != 0 && !alike)
                        fail(DELAM_ERROR_MESH, "the seam at ", place(mesh, pair.first), " has one side only");
                    if (met[other] != 0) continue;
                    if (!alike) facing[other] = turned_over(facing[other]);
                    met[other] = 1;
                    front.push_back(other);
                }
            }
        }
    }
    return seams;
}

NewInterface interface_of(const Mesh& mesh, const std::vector<Facing>& seam, double distance) {
    std::set<NodePair> pairs;
    std::vector<BoundaryFace> faces;
    std::vector<std::vector<NodePair>> of_faces;
    for (const Facing& facing : seam) {
        faces.push_back(facing.face);
        of_faces.push_back(facing.pairs);
        for (const NodePair& pair : facing.pairs)
            if (pair.first != pair.second) pairs.insert(pair);
    }
    const std::vector<NodePair> list(pairs.begin(), pairs.end());
    NewInterface made = assemble_interface(mesh, list, faces, of_faces, distance);
    made.geometry.body_a = made.geometry.body_b = mesh.cell_body(seam.front().face.cell);
    return made;
}

// Faces face each other if their normals are opposite, and the way from one to the other is along them, within 30
// degrees: the round end of a slot faces nothing, its straight walls do.
constexpr double straight = 0.866;
// Cosine between the normals of neighbours, below which there is an edge. (Measured by verify/bench/constants.py with
// case_test_seam and unit_test_seams, of both: 15 and 60 degrees, and 30 and 120, find the same faces.)
constexpr double around_edge = 0.5;

bool share_node(const BoundaryFace& one, const BoundaryFace& other) {
    return std::any_of(one.all().begin(), one.all().end(), [&](std::int64_t node) {
        return std::find(other.all().begin(), other.all().end(), node) != other.all().end();
    });
}

// The outer faces of a body, and which of them face each other.
class FacingWalls {
public:
    FacingWalls(const Mesh& mesh, std::vector<BoundaryFace> faces, double gap);
    // Returns the wall of the faces of `wall` that face `other`; near: with the faces around them.
    std::vector<BoundaryFace> part(std::size_t wall, std::size_t other, bool near) const;
    // Pairs of walls that face each other.
    const std::set<std::pair<std::size_t, std::size_t>>& pairs() const { return pairs_; }

private:
    void find_facing(double gap);
    void find_neighbours();
    void find_walls();

    const Mesh& mesh_;
    std::vector<BoundaryFace> faces_;
    std::vector<Point> normal_;                        // of unit length
    std::vector<std::set<std::size_t>> facing_;        // [faces]
    std::vector<std::vector<std::size_t>> neighbour_;  // [faces] across no edge
    std::vector<std::size_t> wall_;                    // [faces] the lowest of its faces
    std::set<std::pair<std::size_t, std::size_t>> pairs_;
};

FacingWalls::FacingWalls(const Mesh& mesh, std::vector<BoundaryFace> faces, double gap)
    : mesh_(mesh), faces_(std::move(faces)), facing_(faces_.size()), neighbour_(faces_.size()), wall_(faces_.size()) {
    for (const BoundaryFace& face : faces_) {
        Point normal = area_vector(mesh, face.all());
        const double area = length(normal);
        for (double& n : normal) n /= area;
        normal_.push_back(normal);
    }
    find_facing(gap);
    find_neighbours();
    find_walls();
}

void FacingWalls::find_facing(double gap) {
    if (faces_.empty()) return;
    const double rim = 1e-6 * shortest_edge(mesh_, mesh_.body_cells(mesh_.cell_body(faces_.front().cell)));
    std::vector<Box> boxes;
    for (const BoundaryFace& face : faces_) boxes.push_back(box_of(mesh_, face, gap));
    const BoxTree tree(boxes);
    for (std::size_t f = 0; f < faces_.size(); ++f) {
        poll_cancel("pairs", face_work);
        for (const FacePoint& p : inner_points(mesh_, faces_[f]))
            tree.containing(p.place, [&](std::int64_t other) {
                const std::size_t g = index(other);
                if (facing_[f].contains(g) || dot(normal_[f], normal_[g]) > -straight ||
                    share_node(faces_[f], faces_[g]))
                    return;
                // Takes the test of Ground::under, so that what faces is also paired.
                const FacePoint there = closest_point(mesh_, faces_[g], p.place);
                const Point way = there.place - p.place;
                const double distance = length(way), along = std::abs(dot(way, there.normal));
                const double lateral = std::sqrt(std::max(0.0, distance * distance - along * along));
                if (distance > std::max(gap, rim) || lateral > rim + 0.5 * along ||
                    (distance > rim && dot(way, p.normal) < straight * distance))
                    return;
                facing_[f].insert(g);
                facing_[g].insert(f);
            });
    }
}

void FacingWalls::find_neighbours() {
    std::map<std::int64_t, std::vector<std::size_t>> of_node;
    for (std::size_t f = 0; f < faces_.size(); ++f)
        for (const std::int64_t node : faces_[f].corner()) of_node[node].push_back(f);
    for (std::size_t f = 0; f < faces_.size(); ++f) {
        std::map<std::size_t, int> common;
        for (const std::int64_t node : faces_[f].corner())
            for (const std::size_t g : of_node.at(node)) ++common[g];
        for (const auto& [g, nodes] : common)
            if (g != f && nodes >= mesh_.dimension() - 1 && dot(normal_[f], normal_[g]) >= around_edge)
                neighbour_[f].push_back(g);
    }
}

// Walls are neighbours, all of which face something.
void FacingWalls::find_walls() {
    std::vector<std::uint8_t> met(faces_.size(), 0);
    for (std::size_t first = 0; first < faces_.size(); ++first) {
        if (met[first] != 0 || facing_[first].empty()) continue;
        std::vector<std::size_t> front{first};
        met[first] = 1;
        while (!front.empty()) {
            const std::size_t f = front.back();
            front.pop_back();
            wall_[f] = first;
            for (const std::size_t g : neighbour_[f]) {
                if (met[g] != 0 || facing_[g].empty()) continue;
                met[g] = 1;
                front.push_back(g);
            }
        }
    }
    for (std::size_t f = 0; f < faces_.size(); ++f)
        for (const std::size_t g : facing_[f]) {
            if (wall_[f] == wall_[g])
                fail(DELAM_ERROR_MESH, "body ", mesh_.body_label(mesh_.cell_body(faces_[f].cell)),
                     " has a wall that faces itself at ", place(mesh_, faces_[f].node[0]),
                     ": one surface bent back, without an edge that parts its sides");
            pairs_.insert(std::minmax(wall_[f], wall_[g]));
        }
}

std::vector<BoundaryFace> FacingWalls::part(std::size_t wall, std::size_t other, bool near) const {
    std::set<std::size_t> taken;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
        const bool faces =
            std::any_of(facing_[f].begin(), facing_[f].end(), [&](std::size_t g) { return wall_[g] == other; });
        if (!faces || wall_[f] != wall) continue;
        taken.insert(f);
        if (near) taken.insert(neighbour_[f].begin(), neighbour_[f].end());
    }
    std::vector<BoundaryFace> part;
    for (const std::size_t f : taken) part.push_back(faces_[f]);
    return part;
}

// An interface that is found and not yet added.
struct SelfContact {
    UnmatchedFaces faces;
    std::map<std::int64_t, Tie> ties;
};

// Returns the interface of two walls; none: each face of b has a node that a has.
std::optional<SelfContact> self_contact(const Mesh& mesh, std::int32_t body, const FacingWalls& walls, std::size_t a,
                                        std::size_t b, double gap) {
    const std::vector<BoundaryFace> core = walls.part(a, b, false);
    std::vector<BoundaryFace> opposite = walls.part(a, b, true), own = walls.part(b, a, false);
    const auto touches = [](const std::vector<BoundaryFace>& faces) {
        std::set<std::int64_t> nodes;
        for (const BoundaryFace& face : faces) nodes.insert(face.all().begin(), face.all().end());
        return [nodes = std::move(nodes)](const BoundaryFace& face) {
            return std::any_of(face.all().begin(), face.all().end(), [&](std::int64_t n) { return nodes.contains(n); });
        };
    };
    std::erase_if(own, touches(core));
    std::erase_if(opposite, touches(own));
    if (own.empty() || opposite.empty()) return std::nullopt;
    UnmatchedFaces faces(mesh, body, std::move(opposite), std::move(own), gap);
    std::map<std::int64_t, Tie> ties = mortar_ties(mesh, faces);
    return SelfContact{std::move(faces), std::move(ties)};
}

// Faces that overhang on one side are paired from the other.
std::optional<SelfContact> from_either_side(const Mesh& mesh, std::int32_t body, const FacingWalls& walls,
                                            std::size_t a, std::size_t b, double gap) {
    try {
        return self_contact(mesh, body, walls, a, b, gap);
    } catch (const Error& error) {
        if (error.status() != DELAM_ERROR_MESH) throw;
        return self_contact(mesh, body, walls, b, a, gap);
    }
}

}  // namespace

std::vector<Seam> find_seams(const Mesh& mesh) {
    std::vector<BoundaryFace> faces = boundary_faces(mesh, -1);
    const std::vector<std::uint8_t> paired = paired_nodes(mesh);
    std::erase_if(faces, [&](const BoundaryFace& face) {
        return std::all_of(face.all().begin(), face.all().end(), [&](std::int64_t n) { return paired[index(n)] != 0; });
    });
    if (faces.empty()) return {};
    std::vector<std::int64_t> cells(index(mesh.cell_count()));
    std::iota(cells.begin(), cells.end(), std::int64_t{0});
    const double rounding = 1e-6 * shortest_edge(mesh, cells);
    std::vector<Box> boxes;
    std::vector<Point> normal;
    for (const BoundaryFace& face : faces) {
        boxes.push_back(box_of(mesh, face, rounding));
        normal.push_back(area_vector(mesh, face.all()));
    }
    const BoxTree tree(boxes);
    std::map<std::pair<std::int32_t, std::int32_t>, Seam> found;
    for (std::size_t f = 0; f < faces.size(); ++f) {
        poll_cancel("pairs");
        const Point centre = centre_of(mesh, faces[f]);
        std::int64_t on = -1;
        tree.containing(centre, [&](std::int64_t g) {
            const double along = dot(normal[f], normal[index(g)]);
            if (on >= 0 || along > -0.5 * length(normal[f]) * length(normal[index(g)])) return;
            if (length(closest_point(mesh, faces[index(g)], centre).place - centre) <= rounding) on = g;
        });
        // Leaves out faces at the tip of a seam: both have the same node, and their others have pairs.
        if (on < 0 || std::all_of(faces[f].all().begin(), faces[f].all().end(), [&](std::int64_t node) {
                const auto other = faces[index(on)].all();
                return paired[index(node)] != 0 || std::find(other.begin(), other.end(), node) != other.end();
            }))
            continue;
        const auto bodies = std::pair<std::int32_t, std::int32_t>(
            std::minmax({mesh.cell_body(faces[f].cell), mesh.cell_body(faces[index(on)].cell)}));
        Seam& seam = found.try_emplace(bodies, Seam{bodies.first, bodies.second, 0, {centre, centre}}).first->second;
        ++seam.faces;
        for (std::size_t i = 0; i < 3; ++i) {
            seam.box.low[i] = std::min(seam.box.low[i], centre[i]);
            seam.box.high[i] = std::max(seam.box.high[i], centre[i]);
        }
    }
    std::vector<Seam> seams;
    for (const auto& [bodies, seam] : found) seams.push_back(seam);
    return seams;
}

std::int64_t add_seams(Mesh& mesh, double tolerance) {
    if (!(tolerance >= 0.0 && tolerance < 0.5))
        fail(DELAM_ERROR_ARGUMENT, "tolerance ", tolerance, ": must be in [0, 0.5)");
    std::set<NodePair> paired;  // of interfaces of a body with itself, ascending nodes
    for (const InterfaceGeometry& own : mesh.interfaces())
        for (std::size_t p = 0; p < own.node_a.size() && own.body_a == own.body_b; ++p)
            paired.insert(std::minmax(node_of_pair(mesh, own.node_a[p]), node_of_pair(mesh, own.node_b[p])));
    std::vector<NewInterface> made;
    for (std::int32_t body = 0; body < mesh.body_count(); ++body) {
        if (mesh.host_body(body)) continue;
        const double distance = (tolerance > 0.0 ? tolerance : 1e-6) * shortest_edge(mesh, mesh.body_cells(body));
        std::vector<Facing> facing = facing_faces(mesh, boundary_faces(mesh, body), distance);
        std::erase_if(facing, [&](const Facing& f) {
            return std::all_of(f.pairs.begin(), f.pairs.end(), [&](const NodePair& p) {
                return p.first == p.second || paired.contains(std::minmax(p.first, p.second));
            });
        });
        for (const std::vector<Facing>& seam : connected(mesh, std::move(facing)))
            made.push_back(interface_of(mesh, seam, distance));
    }
    const auto count = static_cast<std::int64_t>(made.size());
    append_interfaces(mesh, std::move(made));
    return count;
}

std::int64_t add_self_contact(Mesh& mesh, double gap) {
    if (!(gap > 0.0 && std::isfinite(gap))) fail(DELAM_ERROR_ARGUMENT, "gap = ", gap, ", must be > 0 and finite");
    const std::vector<std::uint8_t> paired = paired_nodes(mesh);
    std::vector<SelfContact> made;
    for (std::int32_t body = 0; body < mesh.body_count(); ++body) {
        if (mesh.host_body(body)) continue;
        std::vector<BoundaryFace> faces = boundary_faces(mesh, body);
        std::erase_if(faces, [&](const BoundaryFace& face) {
            return std::all_of(face.all().begin(), face.all().end(),
                               [&](std::int64_t n) { return paired[index(n)] != 0; });
        });
        const FacingWalls walls(mesh, std::move(faces), gap);
        for (const auto& [a, b] : walls.pairs()) {
            if (std::optional<SelfContact> found = from_either_side(mesh, body, walls, a, b, gap))
                made.push_back(std::move(*found));
        }
    }
    Mesh joined = mesh;  // nothing is added if memory ends or the host cancels on the way
    for (const SelfContact& interface : made) interface.faces.append(joined, interface.ties);
    mesh = std::move(joined);
    return static_cast<std::int64_t>(made.size());
}

}  // namespace delam
