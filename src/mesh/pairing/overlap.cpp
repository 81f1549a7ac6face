// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/pairing/overlap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/cancel_scope.hpp"
#include "mesh/box_tree.hpp"
#include "mesh/faces.hpp"
#include "mesh/points.hpp"

namespace delam {

namespace {

Point unit_normal(const Mesh& mesh, const BoundaryFace& face) {
    Point n = area_vector(mesh, face.all());
    const double length = std::sqrt(dot(n, n));
    for (double& component : n) component /= length;
    return n;
}

bool on_segment(const Point& p, const Point& a, const Point& b, double distance) {
    const Point t = b - a;
    const double share = dot(p - a, t) / dot(t, t);
    if (!(share >= 0.0 && share <= 1.0)) return false;
    const Point off = p - Point{a[0] + share * t[0], a[1] + share * t[1], a[2] + share * t[2]};
    return dot(off, off) <= distance * distance;
}

bool on_triangle(const Point& p, const Point& a, const Point& b, const Point& c, double distance) {
    const Point n = cross(b - a, c - a);
    const double nn = dot(n, n);
    const double height = dot(p - a, n);
    if (!(height * height <= distance * distance * nn)) return false;
    const double rounding = -1e-12 * nn;
    return dot(cross(b - a, p - a), n) >= rounding && dot(cross(c - b, p - b), n) >= rounding &&
           dot(cross(a - c, p - c), n) >= rounding;
}

bool on_face(const Mesh& mesh, const BoundaryFace& face, const Point& p, double distance) {
    const auto pieces = face_pieces(mesh.dimension(), face.all().size());
    return std::any_of(pieces.begin(), pieces.end(), [&](const FacePiece& piece) {
        std::array<Point, 4> x{};
        for (std::size_t k = 0; k < index(piece.nodes); ++k) x[k] = position(mesh, face.node[index(piece.node[k])]);
        if (piece.nodes == 2) return on_segment(p, x[0], x[1], distance);
        return on_triangle(p, x[0], x[1], x[2], distance) ||
               (piece.nodes == 4 && on_triangle(p, x[0], x[2], x[3], distance));
    });
}

// One direction of the test: the centroid of a face, and its nodes moved inwards by a thousandth, so that faces that
// only touch along their rims do not count.
std::pair<std::int64_t, std::int64_t> find_covered(const Mesh& mesh, std::span<const BoundaryFace> under,
                                                   std::span<const BoundaryFace> over, double distance) {
    std::vector<Box> boxes;
    boxes.reserve(under.size());
    for (const BoundaryFace& face : under) boxes.push_back(box_of(mesh, face, distance));
    const BoxTree tree(std::move(boxes));
    for (std::size_t f = 0; f < over.size(); ++f) {
        poll_cancel("pairs", 8);
        const Point normal = unit_normal(mesh, over[f]);
        Point centroid{};
        for (const std::int64_t node : over[f].all())
            for (std::size_t i = 0; i < 3; ++i) centroid[i] += position(mesh, node)[i] / over[f].nodes;
        std::vector<Point> probes{centroid};
        for (const std::int64_t node : over[f].all()) {
            const Point p = position(mesh, node);
            Point q;
            for (std::size_t i = 0; i < 3; ++i) q[i] = p[i] + 1e-3 * (centroid[i] - p[i]);
            probes.push_back(q);
        }
        std::int64_t found = -1;
        for (const Point& probe : probes) {
            tree.containing(probe, [&](std::int64_t g) {
                if (found < 0 && dot(normal, unit_normal(mesh, under[index(g)])) < -0.7 &&
                    on_face(mesh, under[index(g)], probe, distance))
                    found = g;
            });
            if (found >= 0) return {found, static_cast<std::int64_t>(f)};
        }
    }
    return {-1, -1};
}

}  // namespace

std::pair<std::int64_t, std::int64_t> find_overlap(const Mesh& mesh, std::span<const BoundaryFace> faces_a,
                                                   std::span<const BoundaryFace> faces_b, double distance) {
    const auto [a, b] = find_covered(mesh, faces_a, faces_b, distance);
    if (a >= 0) return {a, b};
    const auto [b2, a2] = find_covered(mesh, faces_b, faces_a, distance);
    return {a2, b2};
}

}  // namespace delam
