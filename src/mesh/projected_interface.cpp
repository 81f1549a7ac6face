// SPDX-License-Identifier: BSD-3-Clause
//
// Two bodies whose meshes do not match: each node of b's faces is paired with its projection on a's faces, a tied node
// whose displacement is the one that a has there, sum_i N_i u_i. Weights and normals are those of b's faces, so that
// the tractions of b are its own nodal rule; a receives them through the N_i.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "delam/delam.h"
#include "mesh/assemble_interface.hpp"
#include "mesh/box_tree.hpp"
#include "mesh/face_point.hpp"
#include "mesh/faces.hpp"
#include "mesh/mesh.hpp"
#include "mesh/points.hpp"

namespace delam {

namespace {

// Faces that points may lie on: within `reach` of them, on the side that they look to or behind, and not beyond their
// rim. Where faces bend at an edge, a point over the edge is off both normals by half the bend: what it is off sideways
// may be half of what it is off along the normal, and `rim` for rounding.
class Ground {
public:
    Ground(const Mesh& mesh, std::vector<BoundaryFace> faces, double reach, double rim)
        : mesh_(mesh), faces_(std::move(faces)), reach_(reach), rim_(rim), tree_(boxes()) {}

    struct Found {
        std::size_t face;
        FacePoint point;
    };
    // The nearest place on a face that looks against `normal`, within 60 degrees.
    std::optional<Found> under(const Point& x, const Point& normal) const {
        std::optional<Found> best;
        double nearest = std::numeric_limits<double>::infinity();
        tree_.containing(x, [&](std::int64_t f) {
            const FacePoint p = closest_point(mesh_, faces_[at(f)], x);
            const Point off = x - p.place;
            const double distance = length(off);
            const double along = std::abs(dot(off, p.normal));
            const double aside = std::sqrt(std::max(0.0, distance * distance - along * along));
            if (!(distance <= reach_) || dot(p.normal, normal) > -0.5 || aside > rim_ + 0.5 * along) return;
            if (std::pair(distance, at(f)) < std::pair(nearest, best ? best->face : at(f) + 1)) {
                nearest = distance;
                best = Found{at(f), p};
            }
        });
        return best;
    }
    const BoundaryFace& face(std::size_t f) const { return faces_[f]; }

private:
    const Mesh& mesh_;
    std::vector<BoundaryFace> faces_;
    double reach_;
    double rim_;
    BoxTree tree_;

    // A quadratic face bulges out of the box of its nodes by less than a quarter of its extent.
    std::vector<Box> boxes() const {
        std::vector<Box> list;
        for (const BoundaryFace& face : faces_) {
            const Box box = box_of(mesh_, face, 0.0);
            const double bulge = face.middle().empty() ? 0.0 : 0.25 * length(box.high - box.low);
            list.push_back(box_of(mesh_, face, reach_ + bulge));
        }
        return list;
    }
};

// Of a face whose points are projected, on curved faces by iteration, in cells of a light loop.
constexpr std::int64_t face_work = 32;

struct Split {
    std::vector<BoundaryFace> on, off;
};

}  // namespace

std::int64_t Mesh::add_projected_interface(std::int32_t label_a, std::int32_t label_b, double gap) {
    const auto [a, b] = require_unjoined(label_a, label_b);
    require_cells(a);
    require_cells(b);
    if (!(gap >= 0.0 && std::isfinite(gap))) fail(DELAM_ERROR_ARGUMENT, "gap ", gap, ": must be >= 0 and finite");
    const double edge = std::min(shortest_edge(*this, body_cells(a)), shortest_edge(*this, body_cells(b)));
    const double rim = 1e-6 * edge;
    const double reach = std::max(gap, rim);
    const std::vector<BoundaryFace> faces_a = boundary_faces(*this, a);
    const std::vector<BoundaryFace> faces_b = boundary_faces(*this, b);
    const Ground ground(*this, faces_a, reach, rim);

    // A face of b lies on a as a whole or not at all.
    const auto refuse_partial = [&](const BoundaryFace& face, const Point& off) {
        fail(DELAM_ERROR_MESH, "bodies ", label_a, " and ", label_b, ": the face of cell ", face.cell, " (body ",
             label_b, ") with a corner at ", place(*this, face.node[0]), " lies on faces of body ", label_a,
             " in part only: at ", place(dimension_, off), " there is none within ", reach);
    };
    Split faces;
    for (const BoundaryFace& face : faces_b) {
        poll_cancel("pairs", face_work);
        const std::vector<FacePoint> probes = inner_points(*this, face);
        const auto found = [&](const FacePoint& p) { return ground.under(p.place, p.normal).has_value(); };
        const auto first_off = std::find_if_not(probes.begin(), probes.end(), found);
        if (first_off == probes.end()) {
            faces.on.push_back(face);
        } else if (std::any_of(probes.begin(), probes.end(), found)) {
            refuse_partial(face, first_off->place);
        } else {
            faces.off.push_back(face);
        }
    }
    const Ground apart(*this, faces.off, reach, rim);
    for (const BoundaryFace& face : faces_a) {
        poll_cancel("pairs", face_work);
        for (const FacePoint& p : inner_points(*this, face)) {
            if (const auto found = apart.under(p.place, p.normal)) {
                const BoundaryFace& other = apart.face(found->face);
                fail(DELAM_ERROR_MESH, "bodies ", label_a, " and ", label_b, ": the face of cell ", other.cell,
                     " (body ", label_b, ") with a corner at ", place(*this, other.node[0]), " lies on faces of body ",
                     label_a, " in part only, about ", place(dimension_, p.place));
            }
        }
    }

    // Nodes of b with their projections.
    std::map<std::int64_t, std::pair<double, NodeTie>> tie;
    for (const BoundaryFace& face : faces.on) {
        poll_cancel("pairs", face_work);
        Point normal = area_vector(*this, face.all());
        const double area = length(normal);
        for (double& component : normal) component /= area;
        for (const std::int64_t node : face.all()) {
            const Point x = position(*this, node);
            const auto found = ground.under(x, normal);
            if (!found) refuse_partial(face, x);
            const double distance = length(x - found->point.place);
            const auto known = tie.find(node);
            if (known != tie.end() && known->second.first <= distance) continue;
            NodeTie made{-1, {}};
            const BoundaryFace& below = ground.face(found->face);
            for (std::size_t k = 0; k < below.all().size(); ++k)
                if (found->point.weight[k] != 0.0) made.of.emplace_back(below.node[k], found->point.weight[k]);
            std::sort(made.of.begin(), made.of.end());
            tie[node] = {distance, std::move(made)};
        }
    }
    if (tie.empty()) {
        double nearest = std::numeric_limits<double>::infinity();
        std::int64_t closest = -1;
        std::vector<Box> boxes;
        for (const BoundaryFace& face : faces_a)
            for (const std::int64_t node : face.all()) boxes.push_back({position(*this, node), position(*this, node)});
        const BoxTree tree(std::move(boxes));
        for (const BoundaryFace& face : faces_b)
            for (const std::int64_t node : face.all())
                if (const auto found = tree.nearest(position(*this, node), nearest); found.distance < nearest) {
                    nearest = found.distance;
                    closest = node;
                }
        fail(DELAM_ERROR_MESH, "bodies ", label_a, " and ", label_b, ": no face of body ", label_b,
             " lies on faces of body ", label_a, " within ", reach, "; their boundary nodes come as close as ", nearest,
             " (node ", closest, ")");
    }

    std::vector<NodePair> pairs;
    std::vector<NodeTie> ties;
    std::vector<double> places;
    for (auto& [node, entry] : tie) {
        NodeTie made = std::move(entry.second);
        made.node = node_count() + static_cast<std::int64_t>(ties.size());
        pairs.emplace_back(made.node, node);
        for (std::size_t i = 0; i < at(dimension_); ++i) {
            double x = 0.0;
            for (const auto& [other, weight] : made.of) x += weight * this->node(other)[i];
            places.push_back(x);
        }
        ties.push_back(std::move(made));
    }
    std::vector<BoundaryFace> outward_of_a;
    for (const BoundaryFace& face : faces.on) outward_of_a.push_back(turned(face));
    InterfaceGeometry made = assemble_interface(*this, pairs, outward_of_a, FaceSide::b, rim);
    made.body_a = a;
    made.body_b = b;

    nodes_.reserve(nodes_.size() + places.size());
    node_label_.reserve(node_label_.size() + ties.size());
    node_origin_.reserve(node_origin_.size() + ties.size());
    next_copy_.reserve(next_copy_.size() + ties.size());
    ties_.reserve(ties_.size() + ties.size());
    interfaces_.push_back(std::move(made));
    nodes_.insert(nodes_.end(), places.begin(), places.end());
    for (NodeTie& t : ties) {
        node_label_.push_back(reserved);
        node_origin_.push_back(t.node);
        next_copy_.push_back(-1);
        ties_.push_back(std::move(t));
    }
    return static_cast<std::int64_t>(interfaces_.size()) - 1;
}

}  // namespace delam
