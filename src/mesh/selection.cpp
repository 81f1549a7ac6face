// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/selection.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "delam/delam.h"
#include "mesh/faces.hpp"
#include "mesh/shape.hpp"

namespace delam {

namespace {

// A share of the mesh's size: nodes written with a few digits still lie on the box they should.
constexpr double widening = 1e-9;

void check(const Mesh& mesh, std::int32_t body, std::span<const double> lower, std::span<const double> upper) {
    if (body < -1 || body >= mesh.body_count())
        fail(DELAM_ERROR_ARGUMENT, "body index ", body, ": must be in -1..", mesh.body_count() - 1);
    for (std::size_t i = 0; i < index(mesh.dimension()); ++i)
        if (!(lower[i] <= upper[i]))
            fail(DELAM_ERROR_ARGUMENT, "box along axis ", i, ": lower ", lower[i], " > upper ", upper[i]);
}

// A point of a face together with the shape functions there.
struct Vertex {
    std::array<double, 3> x{};
    std::array<double, 3> share{};  // barycentric
};

// Sutherland and Hodgman (CACM 17, 1974): the part of a convex polygon with sign * (x_axis - bound) >= 0.
std::vector<Vertex> clip(const std::vector<Vertex>& polygon, std::size_t axis, double bound, double sign) {
    std::vector<Vertex> inside;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vertex& p = polygon[k];
        const Vertex& q = polygon[(k + 1) % polygon.size()];
        const double u = sign * (p.x[axis] - bound);
        const double v = sign * (q.x[axis] - bound);
        if (u >= 0.0) inside.push_back(p);
        if ((u < 0.0 && v > 0.0) || (u > 0.0 && v < 0.0)) {
            Vertex cut;
            for (std::size_t i = 0; i < 3; ++i) {
                cut.x[i] = p.x[i] + u / (u - v) * (q.x[i] - p.x[i]);
                cut.share[i] = p.share[i] + u / (u - v) * (q.share[i] - p.share[i]);
            }
            cut.x[axis] = bound;
            inside.push_back(cut);
        }
    }
    return inside;
}

double measure(const Vertex& a, const Vertex& b, const Vertex& c) {
    const double u[3] = {b.x[0] - a.x[0], b.x[1] - a.x[1], b.x[2] - a.x[2]};
    const double v[3] = {c.x[0] - a.x[0], c.x[1] - a.x[1], c.x[2] - a.x[2]};
    return 0.5 * std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
}

class Window {
public:
    Window(const Mesh& mesh, std::span<const double> lower, std::span<const double> upper)
        : mesh_(mesh), lower_(lower), upper_(upper), slack_(widening * mesh.size()) {}

    // Finds the axes along which the box cuts this face. A face that is flat along an axis is never cut there: it is in
    // or out, with the slack; so a box may be a mere plane, and slack adds nothing to a patch. False: the face is
    // outside.
    bool cut_face(std::span<const std::int64_t> nodes) {
        cut_.fill(false);
        for (std::size_t i = 0; i < index(mesh_.dimension()); ++i) {
            double low = mesh_.node(nodes[0])[i];
            double high = low;
            for (const std::int64_t n : nodes) {
                low = std::min(low, mesh_.node(n)[i]);
                high = std::max(high, mesh_.node(n)[i]);
            }
            if (high - low <= 2.0 * slack_) {
                const double middle = low + (high - low) / 2.0;
                if (middle < lower_[i] - slack_ || middle > upper_[i] + slack_) return false;
            } else {
                if (high <= lower_[i] || low >= upper_[i]) return false;
                cut_[i] = low < lower_[i] || high > upper_[i];
            }
        }
        return true;
    }

    // Liang and Barsky (ACM TOG 3, 1984): the stretch [from, to] of an edge inside; N_1 = s and N_0 = 1-s are then
    // integrated exactly by their values at its middle.
    void add_edge(std::span<const std::int64_t> nodes, std::span<double> weight) const {
        const auto p = mesh_.node(nodes[0]);
        const auto q = mesh_.node(nodes[1]);
        double from = 0.0;
        double to = 1.0;
        for (std::size_t i = 0; i < 2; ++i) {
            if (!cut_[i]) continue;
            const double enter = ((q[i] > p[i] ? lower_[i] : upper_[i]) - p[i]) / (q[i] - p[i]);
            const double leave = ((q[i] > p[i] ? upper_[i] : lower_[i]) - p[i]) / (q[i] - p[i]);
            from = std::max(from, enter);
            to = std::min(to, leave);
        }
        if (!(to - from > sliver)) return;
        const double length = (to - from) * std::hypot(q[0] - p[0], q[1] - p[1]);
        const double middle = from + (to - from) / 2.0;
        weight[index(nodes[0])] += length * (1.0 - middle);
        weight[index(nodes[1])] += length * middle;
    }

    // A 3-node edge x(xi) = m + c xi + d xi^2: where it crosses the sides of the box it is cut, and what lies inside is
    // integrated by 5 Gauss points. Exact for straight edges, up to rounding for moderately curved ones.
    void add_quadratic_edge(std::span<const std::int64_t> nodes, std::span<double> weight) const {
        const auto p = mesh_.node(nodes[0]);
        const auto q = mesh_.node(nodes[1]);
        const auto m = mesh_.node(nodes[2]);
        double c[2];
        double d[2];
        for (std::size_t i = 0; i < 2; ++i) {
            c[i] = 0.5 * (q[i] - p[i]);
            d[i] = 0.5 * ((p[i] - m[i]) + (q[i] - m[i]));
        }
        std::vector<double> cuts{-1.0, 1.0};
        for (std::size_t i = 0; i < 2; ++i) {
            if (!cut_[i]) continue;
            for (const double bound : {lower_[i], upper_[i]}) {  // roots of d xi^2 + c xi + (m - bound), without loss
                const double square = c[i] * c[i] - 4.0 * d[i] * (m[i] - bound);
                if (!(square >= 0.0)) continue;
                const double half = -0.5 * (c[i] + std::copysign(std::sqrt(square), c[i]));
                for (const double root : {half / d[i], (m[i] - bound) / half})
                    if (root > -1.0 && root < 1.0) cuts.push_back(root);
            }
        }
        std::sort(cuts.begin(), cuts.end());
        constexpr double point[] = {-0.90617984593866399280, -0.53846931010568309104, 0.0, 0.53846931010568309104,
                                    0.90617984593866399280};
        constexpr double gauss[] = {0.23692688505618908751, 0.47862867049936646804, 0.56888888888888888889,
                                    0.47862867049936646804, 0.23692688505618908751};
        for (std::size_t k = 1; k < cuts.size(); ++k) {
            const double half = 0.5 * (cuts[k] - cuts[k - 1]);
            const double middle = cuts[k - 1] + half;
            bool inside = half > sliver;
            for (std::size_t i = 0; i < 2; ++i) {
                const double x = m[i] + middle * (c[i] + middle * d[i]);
                inside = inside && (!cut_[i] || (x >= lower_[i] && x <= upper_[i]));
            }
            if (!inside) continue;
            for (std::size_t g = 0; g < 5; ++g) {
                const double xi = middle + half * point[g];
                const double ds = half * gauss[g] * std::hypot(c[0] + 2.0 * xi * d[0], c[1] + 2.0 * xi * d[1]);
                weight[index(nodes[0])] += ds * 0.5 * xi * (xi - 1.0);
                weight[index(nodes[1])] += ds * 0.5 * xi * (xi + 1.0);
                weight[index(nodes[2])] += ds * (1.0 - xi * xi);
            }
        }
    }

    // Linear functions are integrated exactly over a triangle by their mean at the corners; the clipped polygon
    // is a fan.
    void add_triangle(const std::array<std::int64_t, 3>& nodes, double factor, std::span<double> weight) const {
        clipped_fan(nodes, [&](const Vertex& a, const Vertex& b, const Vertex& c, double area) {
            for (std::size_t i = 0; i < 3; ++i)
                weight[index(nodes[i])] += factor * area * (a.share[i] + b.share[i] + c.share[i]) / 3.0;
        });
    }

    // A 6-, 8- or 9-node face as triangles between its nodes. The reference coordinates are linear in space within a
    // triangle. The integrals of the shape functions, of degree 3 at most, or 4 with 9 nodes, are therefore exact on a
    // flat face with straight, evenly divided sides; on a curved face they sum to the area of the triangles.
    void add_quadratic_face(std::span<const std::int64_t> nodes, std::span<double> weight) const {
        const CellType type = face_row(3, nodes.size()).surface;
        const auto place = reference_nodes(type);
        const auto add = [&](const std::array<int, 3>& local, double factor) {
            const auto at_share = [&](const std::array<double, 3>& share) {
                ReferencePoint xi{};
                for (std::size_t k = 0; k < 3; ++k)
                    for (std::size_t i = 0; i < 2; ++i) xi[i] += share[k] * place[index(local[k])][i];
                return shape_values(type, xi);
            };
            const std::array<std::int64_t, 3> corner{nodes[index(local[0])], nodes[index(local[1])],
                                                     nodes[index(local[2])]};
            clipped_fan(corner, [&](const Vertex& a, const Vertex& b, const Vertex& c, double area) {
                for (const auto& r : nodes.size() == 9 ? degree_5 : degree_3) {
                    std::array<double, 3> share;
                    for (std::size_t i = 0; i < 3; ++i)
                        share[i] = r[0] * a.share[i] + r[1] * b.share[i] + r[2] * c.share[i];
                    const ShapeValues value = at_share(share);
                    for (std::size_t n = 0; n < nodes.size(); ++n)
                        weight[index(nodes[n])] += factor * area * r[3] / 60.0 * value[n];
                }
            });
        };
        for (const FacePiece& piece : face_pieces(3, nodes.size())) {
            const auto& k = piece.node;
            const double factor = piece.nodes == 3 ? 1.0 : 0.5;
            add({k[0], k[1], k[2]}, factor);
            if (piece.nodes == 3) continue;
            add({k[0], k[2], k[3]}, factor);
            add({k[0], k[1], k[3]}, factor);
            add({k[1], k[2], k[3]}, factor);
        }
    }

private:
    // Rules for a triangle: shares of its corners and 60 times the weight.
    using TriangleRule = std::array<std::array<double, 4>, 7>;
    // Exact to degree 3: corners, middles of sides, centre.
    static constexpr TriangleRule degree_3{{{1, 0, 0, 3},
                                            {0, 1, 0, 3},
                                            {0, 0, 1, 3},
                                            {0.5, 0.5, 0, 8},
                                            {0, 0.5, 0.5, 8},
                                            {0.5, 0, 0.5, 8},
                                            {1.0 / 3, 1.0 / 3, 1.0 / 3, 27}}};
    // Exact to degree 5 (J. Radon, Monatsh. Math. Phys. 52, 1948): shares (6 +- sqrt 15)/21, weights (155 +- sqrt
    // 15)/1200, and 9/40 at the centre.
    static constexpr double root_15 = 3.87298334620741688518;
    static constexpr double near_side = (6 + root_15) / 21, near_corner = (6 - root_15) / 21;
    static constexpr double at_side = (155 + root_15) / 20, at_corner = (155 - root_15) / 20;
    static constexpr TriangleRule degree_5{{{near_side, near_side, 1 - 2 * near_side, at_side},
                                            {near_side, 1 - 2 * near_side, near_side, at_side},
                                            {1 - 2 * near_side, near_side, near_side, at_side},
                                            {near_corner, near_corner, 1 - 2 * near_corner, at_corner},
                                            {near_corner, 1 - 2 * near_corner, near_corner, at_corner},
                                            {1 - 2 * near_corner, near_corner, near_corner, at_corner},
                                            {1.0 / 3, 1.0 / 3, 1.0 / 3, 13.5}}};

    // The part of a triangle in the box, as triangles around its first corner: visit(a, b, c, area).
    template <class Visit>
    void clipped_fan(const std::array<std::int64_t, 3>& nodes, Visit&& visit) const {
        std::vector<Vertex> polygon(3);
        for (std::size_t k = 0; k < 3; ++k) {
            std::copy(mesh_.node(nodes[k]).begin(), mesh_.node(nodes[k]).end(), polygon[k].x.begin());
            polygon[k].share[k] = 1.0;
        }
        const double whole = measure(polygon[0], polygon[1], polygon[2]);
        for (std::size_t i = 0; i < 3; ++i) {
            if (!cut_[i]) continue;
            polygon = clip(polygon, i, lower_[i], 1.0);
            polygon = clip(polygon, i, upper_[i], -1.0);
        }
        for (std::size_t k = 2; k < polygon.size(); ++k) {
            const double area = measure(polygon[0], polygon[k - 1], polygon[k]);
            if (area > sliver * whole) visit(polygon[0], polygon[k - 1], polygon[k], area);
        }
    }

    static constexpr double sliver = 1e-12;  // shares of a face below this are rounding of the box's place

    const Mesh& mesh_;
    std::span<const double> lower_, upper_;
    double slack_;
    std::array<bool, 3> cut_{};
};

}  // namespace

std::vector<std::int64_t> find_nodes(const Mesh& mesh, std::int32_t body, std::span<const double> lower,
                                     std::span<const double> upper) {
    check(mesh, body, lower, upper);
    const double slack = widening * mesh.size();
    std::vector<std::int64_t> found;
    std::size_t tie = 0;  // tied nodes are no places to hold or load anything at
    for (std::int64_t n = 0; n < mesh.node_count(); ++n) {
        if (tie < mesh.ties().size() && mesh.ties()[tie].node == n) {
            ++tie;
            continue;
        }
        const auto p = mesh.node(n);
        bool inside = true;
        for (std::size_t i = 0; i < p.size(); ++i)
            inside = inside && p[i] >= lower[i] - slack && p[i] <= upper[i] + slack;
        if (inside && (body < 0 || mesh.node_body(n) == body)) found.push_back(n);
    }
    return found;
}

Patch find_patch(const Mesh& mesh, std::int32_t body, std::span<const double> lower, std::span<const double> upper,
                 std::span<const double> direction) {
    check(mesh, body, lower, upper);
    double length = 0.0;
    for (const double d : direction) length = std::hypot(length, d);
    if (!(length > 0.0)) fail(DELAM_ERROR_ARGUMENT, "direction: its length is ", length, ", must be > 0");
    if (body >= 0 && mesh.host_body(body))
        fail(DELAM_ERROR_ARGUMENT, "body ", mesh.body_label(body), " has no cells and so no faces");

    std::vector<double> weight(index(mesh.node_count()), 0.0);
    Window window(mesh, lower, upper);
    const double cosine = std::sqrt(0.5) - 1e-9;  // 45 degrees, the limit included
    for (std::int32_t b = body < 0 ? 0 : body; b < (body < 0 ? mesh.body_count() : body + 1); ++b) {
        for (const BoundaryFace& face : boundary_faces(mesh, b)) {
            poll_cancel("mesh", 2);
            const auto nodes = face.all();
            if (!window.cut_face(nodes)) continue;
            const auto area = area_vector(mesh, nodes);
            double along = 0.0;
            for (std::size_t i = 0; i < direction.size(); ++i) along += area[i] * (direction[i] / length);
            if (along < cosine * std::hypot(area[0], area[1], area[2])) continue;
            const bool quadratic = face.nodes > face.corners;
            if (quadratic && face.corners == 2) window.add_quadratic_edge(nodes, weight);
            if (quadratic && face.corners > 2) window.add_quadratic_face(nodes, weight);
            if (face.nodes == 2) window.add_edge(nodes, weight);
            if (!quadratic && face.nodes == 3) window.add_triangle({nodes[0], nodes[1], nodes[2]}, 1.0, weight);
            if (face.nodes == 4) {  // the mean of both ways to halve it: no corner is preferred
                window.add_triangle({nodes[0], nodes[1], nodes[2]}, 0.5, weight);
                window.add_triangle({nodes[0], nodes[2], nodes[3]}, 0.5, weight);
                window.add_triangle({nodes[0], nodes[1], nodes[3]}, 0.5, weight);
                window.add_triangle({nodes[1], nodes[2], nodes[3]}, 0.5, weight);
            }
        }
    }
    // The corners of a 6-node triangle have no share at all, up to rounding.
    const double largest = max_abs(weight);
    Patch patch;
    for (std::int64_t n = 0; n < mesh.node_count(); ++n) {
        if (!(std::abs(weight[index(n)]) > 1e-13 * largest)) continue;
        patch.nodes.push_back(n);
        patch.weights.push_back(weight[index(n)]);
    }
    return patch;
}

}  // namespace delam
