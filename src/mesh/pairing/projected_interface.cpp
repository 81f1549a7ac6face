// SPDX-License-Identifier: BSD-3-Clause
//
// Two bodies whose meshes do not match: each node of b's faces is paired with its projection on a's faces, a tied node
// whose displacement is that of a there, sum_i N_i u_i. Weights and normals are those of b's faces, so that the
// tractions on b follow its own nodal rule; a receives them through the N_i.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "mesh/box_tree.hpp"
#include "mesh/face_point.hpp"
#include "mesh/faces.hpp"
#include "mesh/mesh.hpp"
#include "mesh/pairing/assemble_interface.hpp"
#include "mesh/pairing/interfaces.hpp"
#include "mesh/points.hpp"

namespace delam {

namespace {

// Faces on which points may lie: within `reach` of them, on their front side or behind, and not beyond their rim. Where
// faces meet at an angle, a point above the edge deviates from both normals by half the angle, so its sideways distance
// may be half of its normal distance, plus `rim` for rounding.
class Ground {
public:
    Ground(const Mesh& mesh, std::vector<BoundaryFace> faces, double reach, double rim)
        : mesh_(mesh), faces_(std::move(faces)), reach_(reach), rim_(rim), tree_(boxes()) {}

    struct Found {
        std::size_t face;
        FacePoint point;
    };
    // The nearest point on a face that is oriented against `normal`, within 60 degrees.
    std::optional<Found> under(const Point& x, const Point& normal) const {
        std::optional<Found> best;
        double nearest = std::numeric_limits<double>::infinity();
        tree_.containing(x, [&](std::int64_t f) {
            const FacePoint p = closest_point(mesh_, faces_[index(f)], x);
            const Point off = x - p.place;
            const double distance = length(off);
            const double along = std::abs(dot(off, p.normal));
            const double lateral = std::sqrt(std::max(0.0, distance * distance - along * along));
            if (!(distance <= reach_) || dot(p.normal, normal) > -0.5 || lateral > rim_ + 0.5 * along) return;
            if (std::pair(distance, index(f)) < std::pair(nearest, best ? best->face : index(f) + 1)) {
                nearest = distance;
                best = Found{index(f), p};
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

    // A quadratic face extends beyond the box of its nodes by less than a quarter of its extent.
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

// Work for a face whose points are projected (by iteration on curved faces), in cells of a light loop.
constexpr std::int64_t face_work = 32;

struct Split {
    std::vector<BoundaryFace> on, off;
};

// The nodes of b's faces with their projections: for each node, the distance and the tie, whose own node is not known
// yet.
using Projected = std::map<std::int64_t, std::pair<double, NodeTie>>;

// Projects body b onto body a, before the mesh changes.
class Projection {
public:
    Projection(const Mesh& mesh, std::int32_t a, std::int32_t b, double reach, double rim)
        : mesh_(mesh),
          label_a_(mesh.body_label(a)),
          label_b_(mesh.body_label(b)),
          reach_(reach),
          rim_(rim),
          faces_a_(boundary_faces(mesh, a)),
          faces_b_(boundary_faces(mesh, b)),
          ground_(mesh, faces_a_, reach, rim) {}

    // A face of b lies on a completely or not at all.
    Split split_faces() const {
        Split faces;
        for (const BoundaryFace& face : faces_b_) {
            poll_cancel("pairs", face_work);
            const std::vector<FacePoint> probes = inner_points(mesh_, face);
            const auto found = [&](const FacePoint& p) { return ground_.under(p.place, p.normal).has_value(); };
            const auto first_off = std::find_if_not(probes.begin(), probes.end(), found);
            if (first_off == probes.end())
                faces.on.push_back(face);
            else if (std::any_of(probes.begin(), probes.end(), found))
                refuse_partial(face, first_off->place);
            else
                faces.off.push_back(face);
        }
        return faces;
    }

    // Checks the other direction: no face of a may lie on faces of b that were left out.
    void refuse_covered(const std::vector<BoundaryFace>& off) const {
        const Ground apart(mesh_, off, reach_, rim_);
        for (const BoundaryFace& face : faces_a_) {
            poll_cancel("pairs", face_work);
            for (const FacePoint& p : inner_points(mesh_, face)) {
                const auto found = apart.under(p.place, p.normal);
                if (!found) continue;
                const BoundaryFace& other = apart.face(found->face);
                fail(DELAM_ERROR_MESH, "bodies ", label_a_, " and ", label_b_, ": the face of cell ", other.cell,
                     " (body ", label_b_, ") with a corner at ", place(mesh_, other.node[0]), " lies on faces of body ",
                     label_a_, " only in part, near ", place(mesh_.dimension(), p.place));
            }
        }
    }

    // The nearest of a node's projections from its faces.
    Projected project_nodes(const std::vector<BoundaryFace>& on) const {
        Projected projected;
        for (const BoundaryFace& face : on) {
            poll_cancel("pairs", face_work);
            Point normal = area_vector(mesh_, face.all());
            const double area = length(normal);
            for (double& component : normal) component /= area;
            for (const std::int64_t node : face.all()) {
                const Point x = position(mesh_, node);
                const auto found = ground_.under(x, normal);
                if (!found) refuse_partial(face, x);
                const double distance = length(x - found->point.place);
                const auto known = projected.find(node);
                if (known != projected.end() && known->second.first <= distance) continue;
                projected[node] = {distance, tie_of(*found)};
            }
        }
        return projected;
    }

    [[noreturn]] void refuse_apart() const {
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
        fail(DELAM_ERROR_MESH, "bodies ", label_a_, " and ", label_b_, ": no face of body ", label_b_,
             " lies on faces of body ", label_a_, " within ", reach_, "; their boundary nodes come as close as ",
             nearest, " (node ", closest, ")");
    }

private:
    const Mesh& mesh_;
    std::int32_t label_a_, label_b_;
    double reach_, rim_;
    std::vector<BoundaryFace> faces_a_, faces_b_;
    Ground ground_;

    [[noreturn]] void refuse_partial(const BoundaryFace& face, const Point& off) const {
        fail(DELAM_ERROR_MESH, "bodies ", label_a_, " and ", label_b_, ": the face of cell ", face.cell, " (body ",
             label_b_, ") with a corner at ", place(mesh_, face.node[0]), " lies on faces of body ", label_a_,
             " only in part: at ", place(mesh_.dimension(), off), " there is none within ", reach_);
    }

    NodeTie tie_of(const Ground::Found& found) const {
        NodeTie made{-1, {}};
        const BoundaryFace& below = ground_.face(found.face);
        for (std::size_t k = 0; k < below.all().size(); ++k)
            if (found.point.weight[k] != 0.0) made.of.emplace_back(below.node[k], found.point.weight[k]);
        std::sort(made.of.begin(), made.of.end());
        return made;
    }
};

}  // namespace

std::int64_t add_projected_interface(Mesh& mesh, std::int32_t label_a, std::int32_t label_b, double gap) {
    const auto [a, b] = require_unjoined(mesh, label_a, label_b);
    require_cells(mesh, a);
    require_cells(mesh, b);
    if (!(gap >= 0.0 && std::isfinite(gap))) fail(DELAM_ERROR_ARGUMENT, "gap ", gap, ": must be >= 0 and finite");
    const double edge = std::min(shortest_edge(mesh, mesh.body_cells(a)), shortest_edge(mesh, mesh.body_cells(b)));
    const double rim = 1e-6 * edge;
    const Projection projection(mesh, a, b, std::max(gap, rim), rim);
    const Split faces = projection.split_faces();
    projection.refuse_covered(faces.off);
    Projected projected = projection.project_nodes(faces.on);
    if (projected.empty()) projection.refuse_apart();

    std::vector<NodePair> pairs;
    std::vector<NodeTie> ties;
    std::vector<double> places;
    for (auto& [node, entry] : projected) {
        NodeTie made = std::move(entry.second);
        made.node = mesh.node_count() + static_cast<std::int64_t>(ties.size());
        pairs.emplace_back(made.node, node);
        for (std::size_t i = 0; i < index(mesh.dimension()); ++i) {
            double x = 0.0;
            for (const auto& [other, weight] : made.of) x += weight * mesh.node(other)[i];
            places.push_back(x);
        }
        ties.push_back(std::move(made));
    }
    std::vector<BoundaryFace> outward_of_a;
    for (const BoundaryFace& face : faces.on) outward_of_a.push_back(turned(face));
    InterfaceGeometry made = assemble_interface(mesh, pairs, outward_of_a, FaceSide::b, rim);
    made.body_a = a;
    made.body_b = b;
    return mesh.append(std::move(made), std::move(ties), places);
}

}  // namespace delam
