// SPDX-License-Identifier: BSD-3-Clause
// Boundary faces of two bodies whose meshes do not match: which faces of b lie on faces of a, and the interface that
// ties the nodes of these to a.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "mesh/box_tree.hpp"
#include "mesh/face_point.hpp"
#include "mesh/faces.hpp"
#include "mesh/mesh.hpp"

namespace delam {

// Work for a face whose points are projected (by iteration on curved faces), in cells of a light loop, for poll_cancel.
inline constexpr std::int64_t face_work = 32;

// Faces on which points may lie: within `reach` of them, on their front side or behind, and not beyond their rim. Where
// faces meet at an angle, a point above the edge deviates from both normals by half the angle, so its sideways distance
// may be half of its normal distance, plus `rim` for rounding.
class Ground {
public:
    Ground(const Mesh& mesh, std::vector<BoundaryFace> faces, double reach, double rim);

    struct Found {
        std::size_t face;
        FacePoint point;
    };
    // Returns the nearest point on a face that is oriented against `normal`, within 60 degrees.
    std::optional<Found> under(const Point& x, const Point& normal) const;
    // Returns the faces whose boxes, widened by reach, have a point in common with this box, in ascending order.
    std::vector<std::size_t> meeting(const Box& box) const;
    const BoundaryFace& face(std::size_t f) const { return faces_[f]; }
    double reach() const { return reach_; }

private:
    const Mesh& mesh_;
    std::vector<BoundaryFace> faces_;
    double reach_;
    double rim_;
    std::vector<Box> around_;         // [faces] the face lies in it
    std::vector<NormalCone> normal_;  // [faces]
    BoxTree tree_;                    // of around_, widened by reach

    std::vector<Box> boxes(double widened) const;
};

// The nodes to which a node is tied, ascending, with weights that sum to 1.
using Tie = std::vector<std::pair<std::int64_t, double>>;

// Returns the tie to a point of a face.
Tie tie_to(const BoundaryFace& face, const FacePoint& point);

// Faces of b that come within the gap of a, and are farther away elsewhere, although a lies below all of them.
enum class LeavingFaces { refuse, take };

// The faces of body b beside those of body a.
class UnmatchedFaces {
public:
    // Throws Error(DELAM_ERROR_ARGUMENT) for labels of bodies that do not exist, are joined or have no cells, and for a
    // gap that is negative or not finite. Throws Error(DELAM_ERROR_MESH) if a face of b lies on a only in part, or none
    // lies on a.
    UnmatchedFaces(const Mesh& mesh, std::int32_t label_a, std::int32_t label_b, double gap, LeavingFaces leaving);

    // The same for faces of one body: `walls` beside `opposite`.
    UnmatchedFaces(const Mesh& mesh, std::int32_t body, std::vector<BoundaryFace> opposite,
                   std::vector<BoundaryFace> walls, double gap);

    // Faces of b that lie on faces of a.
    const std::vector<BoundaryFace>& on() const { return on_; }
    const Ground& ground() const { return ground_; }
    // Throws Error(DELAM_ERROR_MESH): this face of b lies on a only in part, there is nothing at `off`.
    [[noreturn]] void refuse_partial(const BoundaryFace& face, const Point& off) const;
    // Appends the interface to the mesh, with a tied node for each node of on(); returns its index.
    std::int64_t append(Mesh& mesh, const std::map<std::int64_t, Tie>& ties) const;

private:
    const Mesh& mesh_;
    std::int32_t a_, b_;
    double rim_, reach_;
    LeavingFaces leaving_;
    std::vector<BoundaryFace> faces_a_, faces_b_;
    Ground ground_;
    std::vector<BoundaryFace> on_;

    std::vector<BoundaryFace> split();
    void refuse_covered(std::vector<BoundaryFace> off) const;
    [[noreturn]] void refuse_apart() const;
};

}  // namespace delam
