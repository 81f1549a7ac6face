// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/pairing/unmatched_faces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "mesh/pairing/assemble_interface.hpp"
#include "mesh/pairing/interfaces.hpp"
#include "mesh/points.hpp"
#include "mesh/rule/mid_sides.hpp"

namespace delam {

namespace {

double require_gap(double gap) {
    if (!(gap >= 0.0 && std::isfinite(gap))) fail(DELAM_ERROR_ARGUMENT, "gap ", gap, ": must be >= 0 and finite");
    return gap;
}

std::pair<std::int32_t, std::int32_t> require_bodies(const Mesh& mesh, std::int32_t label_a, std::int32_t label_b) {
    const auto bodies = require_unjoined(mesh, label_a, label_b);
    require_cells(mesh, bodies.first);
    require_cells(mesh, bodies.second);
    return bodies;
}

double rounding_of_places(const Mesh& mesh, std::int32_t a, std::int32_t b) {
    return 1e-6 * std::min(shortest_edge(mesh, mesh.body_cells(a)), shortest_edge(mesh, mesh.body_cells(b)));
}

// Faces are beside each other within 60 degrees: the cosine between one normal and the other's opposite is at least
// this. Beyond the angle they are not, whatever the rounding.
constexpr double facing = 0.5;
constexpr double most_turned = std::numbers::pi / 3.0 + 1e-6;

// Returns the largest extent of a face.
double longest(const Mesh& mesh, const std::vector<BoundaryFace>& faces) {
    double most = 0.0;
    for (const BoundaryFace& face : faces) {
        const Box box = box_of(mesh, face, 0.0);
        most = std::max(most, length(box.high - box.low));
    }
    return most;
}

}  // namespace

Ground::Ground(const Mesh& mesh, std::vector<BoundaryFace> faces, double reach, double rim)
    : mesh_(mesh), faces_(std::move(faces)), reach_(reach), rim_(rim), around_(boxes(0.0)), tree_(boxes(reach)) {
    for (const BoundaryFace& face : faces_) normal_.push_back(normal_cone(mesh, face));
}

// Most candidates need no projection: their normals, of which the cone tells, are no such ones, or their boxes are
// farther away than a face that has been found.
std::optional<Ground::Found> Ground::under(const Point& x, const Point& normal) const {
    std::vector<std::pair<double, std::size_t>> candidates;  // distance of the box
    tree_.containing(x, [&](std::int64_t f) {
        const NormalCone& cone = normal_[index(f)];
        // Between its nodes a curved face may turn by as much again.
        const double turned = std::acos(std::clamp(-dot(cone.axis, normal), -1.0, 1.0)) - 2.0 * cone.angle;
        if (!(turned > most_turned)) candidates.emplace_back(distance(around_[index(f)], x), index(f));
    });
    std::sort(candidates.begin(), candidates.end());
    std::optional<Found> best;
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& [least, f] : candidates) {
        if (least > nearest) break;
        const FacePoint p = closest_point(mesh_, faces_[f], x);
        const Point off = x - p.place;
        const double distance = length(off);
        const double along = std::abs(dot(off, p.normal));
        const double lateral = std::sqrt(std::max(0.0, distance * distance - along * along));
        if (!(distance <= reach_) || dot(p.normal, normal) > -facing || lateral > rim_ + 0.5 * along) continue;
        if (std::pair(distance, f) < std::pair(nearest, best ? best->face : f + 1)) {
            nearest = distance;
            best = Found{f, p};
        }
    }
    return best;
}

std::vector<std::size_t> Ground::meeting(const Box& box) const {
    std::vector<std::size_t> found;
    tree_.meeting(box, [&](std::int64_t f) { found.push_back(index(f)); });
    std::sort(found.begin(), found.end());
    return found;
}

// A quadratic face extends beyond the box of its nodes by less than a quarter of its extent.
std::vector<Box> Ground::boxes(double widened) const {
    std::vector<Box> list;
    for (const BoundaryFace& face : faces_) {
        const Box box = box_of(mesh_, face, 0.0);
        const double bulge = face.middle().empty() ? 0.0 : 0.25 * length(box.high - box.low);
        list.push_back(box_of(mesh_, face, widened + bulge));
    }
    return list;
}

Tie tie_to(const BoundaryFace& face, const FacePoint& point) {
    Tie tie;
    for (std::size_t k = 0; k < face.all().size(); ++k)
        if (point.weight[k] != 0.0) tie.emplace_back(face.node[k], point.weight[k]);
    std::sort(tie.begin(), tie.end());
    return tie;
}

UnmatchedFaces::UnmatchedFaces(const Mesh& mesh, std::int32_t label_a, std::int32_t label_b, double gap,
                               LeavingFaces leaving)
    : mesh_(mesh),
      a_(require_bodies(mesh, label_a, label_b).first),
      b_(require_bodies(mesh, label_a, label_b).second),
      rim_(rounding_of_places(mesh, a_, b_)),
      reach_(std::max(require_gap(gap), rim_)),
      leaving_(leaving),
      faces_a_(boundary_faces(mesh, a_)),
      faces_b_(boundary_faces(mesh, b_)),
      ground_(mesh, faces_a_, leaving == LeavingFaces::take ? reach_ + longest(mesh, faces_b_) : reach_, rim_),
      on_(split()) {}

UnmatchedFaces::UnmatchedFaces(const Mesh& mesh, std::int32_t body, std::vector<BoundaryFace> opposite,
                               std::vector<BoundaryFace> walls, double gap)
    : mesh_(mesh),
      a_(body),
      b_(body),
      rim_(rounding_of_places(mesh, body, body)),
      reach_(std::max(require_gap(gap), rim_)),
      leaving_(LeavingFaces::take),
      faces_a_(std::move(opposite)),
      faces_b_(std::move(walls)),
      ground_(mesh, faces_a_, reach_ + longest(mesh, faces_b_), rim_),
      on_(split()) {}

// A face of b lies on a completely or not at all.
std::vector<BoundaryFace> UnmatchedFaces::split() {
    std::vector<BoundaryFace> on, off;
    for (const BoundaryFace& face : faces_b_) {
        poll_cancel("pairs", face_work);
        bool near = false;
        std::optional<Point> first_off;
        for (const FacePoint& p : inner_points(mesh_, face)) {
            const auto found = ground_.under(p.place, p.normal);
            near = near || (found && length(p.place - found->point.place) <= reach_);
            if (!found && !first_off) first_off = p.place;
        }
        if (near && first_off) refuse_partial(face, *first_off);
        (near ? on : off).push_back(face);
    }
    refuse_covered(std::move(off));
    if (on.empty()) refuse_apart();
    return on;
}

// Checks the other direction: no face of a may lie on faces of b that were left out. The distance of a point of a from
// a face of b that leaves it at up to 60 degrees is at least half of that face's distance from a.
void UnmatchedFaces::refuse_covered(std::vector<BoundaryFace> off) const {
    const double part = leaving_ == LeavingFaces::take ? 0.5 : 1.0;
    const Ground apart(mesh_, std::move(off), std::max(part * reach_, rim_), rim_);
    for (const BoundaryFace& face : faces_a_) {
        poll_cancel("pairs", face_work);
        for (const FacePoint& p : inner_points(mesh_, face))
            if (const auto found = apart.under(p.place, p.normal)) refuse_partial(apart.face(found->face), p.place);
    }
}

void UnmatchedFaces::refuse_apart() const {
    double nearest = std::numeric_limits<double>::infinity();
    std::int64_t closest = -1;
    std::vector<Box> boxes;
    for (const BoundaryFace& face : faces_a_)
        for (const std::int64_t node : face.all()) boxes.push_back({position(mesh_, node), position(mesh_, node)});
    const BoxTree tree(std::move(boxes));
    for (const BoundaryFace& face : faces_b_)
        for (const std::int64_t node : face.all())
            if (const auto found = tree.nearest(position(mesh_, node), nearest); found.distance < nearest) {
                nearest = found.distance;
                closest = node;
            }
    fail(DELAM_ERROR_MESH, "bodies ", mesh_.body_label(a_), " and ", mesh_.body_label(b_), ": no face of body ",
         mesh_.body_label(b_), " lies on faces of body ", mesh_.body_label(a_), " within ", reach_,
         "; their boundary nodes come as close as ", nearest, " (node ", closest, ")");
}

void UnmatchedFaces::refuse_partial(const BoundaryFace& face, const Point& off) const {
    fail(DELAM_ERROR_MESH, "bodies ", mesh_.body_label(a_), " and ", mesh_.body_label(b_), ": the face of cell ",
         face.cell, " (body ", mesh_.body_label(b_), ") with a corner at ", place(mesh_, face.node[0]),
         " lies on faces of body ", mesh_.body_label(a_), " only in part, near ", place(mesh_.dimension(), off),
         " (within ", reach_, ")");
}

std::int64_t UnmatchedFaces::append(Mesh& mesh, const std::map<std::int64_t, Tie>& ties) const {
    std::vector<NodePair> pairs;
    std::vector<NodeTie> made;
    std::vector<double> places;
    for (const auto& [node, tie] : ties) {
        made.push_back({mesh.node_count() + static_cast<std::int64_t>(made.size()), tie});
        pairs.emplace_back(made.back().node, node);
        for (std::size_t i = 0; i < index(mesh.dimension()); ++i) {
            double x = 0.0;
            for (const auto& [other, weight] : tie) x += weight * mesh.node(other)[i];
            places.push_back(x);
        }
    }
    std::vector<BoundaryFace> outward_of_a;
    for (const BoundaryFace& face : on_) outward_of_a.push_back(turned(face));
    NewInterface interface = assemble_interface(mesh, pairs, outward_of_a, FaceSide::b, rim_);
    interface.geometry.body_a = a_;
    interface.geometry.body_b = b_;
    if (leaving_ == LeavingFaces::take) interface.geometry.reach = reach_;
    return append_interface(mesh, std::move(interface), std::move(made), std::move(places));
}

}  // namespace delam
