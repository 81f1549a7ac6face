// SPDX-License-Identifier: BSD-3-Clause
//
// Rules whose points are the nodes keep the stiffness of an interface diagonal. With the integrals of the shape
// functions as weights, the corners of a 6-node triangle would have weight zero and those of an 8-node face a negative
// weight: interfaces between such faces have other pairs (mid_sides.hpp), and obstacles the weights of linear pieces.
#include "mesh/rule/nodal_rule.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/faces.hpp"
#include "mesh/points.hpp"
#include "mesh/shape.hpp"

namespace delam {

namespace {

// Returns the weights of the nodes of a linear face: the trapezoid on edges, a third each on triangles; on
// quadrilaterals, by 2 x 2 Gauss points at which all N_a are positive,
// w_a = int N_a |x_xi x x_eta| dxi deta.
std::array<double, 4> linear_weights(const Mesh& mesh, std::span<const std::int64_t> nodes) {
    std::array<double, 4> weights{};
    if (nodes.size() != 4) {
        const auto count = static_cast<double>(nodes.size());
        std::fill_n(weights.begin(), nodes.size(), length(area_vector(mesh, nodes)) / count);
        return weights;
    }
    const Quadrature& gauss = quadrature(CellType::quad4);
    for (std::size_t q = 0; q < gauss.points.size(); ++q) {
        const ShapeGradient& g = gauss.gradients[q];
        const ShapeValues value = shape_values(CellType::quad4, gauss.points[q]);
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
        for (std::size_t a = 0; a < 4; ++a) weights[a] += gauss.weights[q] * area * value[a];
    }
    return weights;
}

// The parabola through the corners p, q at xi = -1, 1 and the mid-side node m at 0: its tangent x'(xi).
class Parabola {
public:
    Parabola(std::span<const double> p, std::span<const double> q, std::span<const double> m) {
        for (std::size_t i = 0; i < 2; ++i) {
            slope_[i] = 0.5 * (q[i] - p[i]);
            bend_[i] = (p[i] - m[i]) + (q[i] - m[i]);
        }
    }
    Point tangent(double xi) const { return {slope_[0] + xi * bend_[0], slope_[1] + xi * bend_[1], 0.0}; }

    // 5 Gauss points: the relative error of the length is 1e-8 if the arc turns by 45 degrees, 1e-5 if it turns by 90.
    double arc() const {
        constexpr double point[] = {-0.90617984593866399280, -0.53846931010568309104, 0.0, 0.53846931010568309104,
                                    0.90617984593866399280};
        constexpr double weight[] = {0.23692688505618908751, 0.47862867049936646804, 0.56888888888888888889,
                                     0.47862867049936646804, 0.23692688505618908751};
        double sum = 0.0;
        for (std::size_t k = 0; k < 5; ++k) sum += weight[k] * length(tangent(point[k]));
        return sum;
    }

private:
    std::array<double, 2> slope_{}, bend_{};
};

// Simpson's rule with the Jacobian of the edge,
//     w ~ (1/3, 1/3, 4/3) |x'(xi)|  at the corners and the middle,
// is exact for straight edges, wherever m lies on them. On a curved edge |x'| is no polynomial, so the weights are
// scaled to the length of the arc.
NodalRule quadratic_edge(const Mesh& mesh, std::span<const std::int64_t> nodes) {
    const Parabola edge(mesh.node(nodes[0]), mesh.node(nodes[1]), mesh.node(nodes[2]));
    constexpr double xi[] = {-1.0, 1.0, 0.0};
    constexpr double simpson[] = {1.0 / 3.0, 1.0 / 3.0, 4.0 / 3.0};
    NodalRule rule;
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k) sum += simpson[k] * length(edge.tangent(xi[k]));
    const double scale = edge.arc() / sum;
    for (std::size_t k = 0; k < 3; ++k) {
        const Point t = edge.tangent(xi[k]);
        rule.weight[k] = scale * simpson[k] * length(t);
        rule.area[k] = {scale * simpson[k] * t[1], -scale * simpson[k] * t[0], 0.0};
    }
    return rule;
}

// x_xi x x_eta of a face in space.
Point area_at(const Mesh& mesh, std::span<const std::int64_t> nodes, const ShapeGradient& g) {
    Point u{};
    Point v{};
    for (std::size_t a = 0; a < nodes.size(); ++a)
        for (std::size_t i = 0; i < 3; ++i) {
            const double x = mesh.node(nodes[a])[i] - mesh.node(nodes[0])[i];
            u[i] += g[2 * a] * x;
            v[i] += g[2 * a + 1] * x;
        }
    return cross(u, v);
}

// Simpson's rule in both directions with the area vectors x_xi x x_eta of a 9-node face: exact to the third degree in
// each variable, so that area vectors, and the forces of a uniform traction, are exact even on curved faces.
NodalRule quadratic_face(const Mesh& mesh, std::span<const std::int64_t> nodes) {
    NodalRule rule;
    const std::span<const ReferencePoint> places = reference_nodes(CellType::quad9);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        const Point area = area_at(mesh, nodes, reference_gradient(CellType::quad9, places[k]));
        const double simpson = (places[k][0] == 0.0 ? 4.0 : 1.0) * (places[k][1] == 0.0 ? 4.0 : 1.0) / 9.0;
        for (std::size_t i = 0; i < 3; ++i) rule.area[k][i] = simpson * area[i];
        rule.weight[k] = length(rule.area[k]);
    }
    return rule;
}

}  // namespace

NodalRule nodal_rule(const Mesh& mesh, std::span<const std::int64_t> nodes) {
    if (mesh.dimension() == 2 && nodes.size() == 3) return quadratic_edge(mesh, nodes);
    if (nodes.size() == 9) return quadratic_face(mesh, nodes);
    NodalRule rule;
    for (const FacePiece& piece : face_pieces(mesh.dimension(), nodes.size())) {
        std::array<std::int64_t, 4> own{};
        for (std::size_t k = 0; k < index(piece.nodes); ++k) own[k] = nodes[index(piece.node[k])];
        const auto corner = std::span<const std::int64_t>(own).first(index(piece.nodes));
        const std::array<double, 4> weight = linear_weights(mesh, corner);
        const Point area = area_vector(mesh, corner);
        for (std::size_t k = 0; k < index(piece.nodes); ++k) {
            const auto node = index(piece.node[k]);
            rule.weight[node] += weight[k];
            for (std::size_t i = 0; i < 3; ++i) rule.area[node][i] += area[i];
        }
    }
    return rule;
}

// Points and weights on the reference cell of a 6- or 8-node face: exact to degree 4 on triangles, where the six points
// are those of wedge15 along its axis of length 2, and to degree 5 in each variable on quadrilaterals.
NodalRule shape_integrals(const Mesh& mesh, std::span<const std::int64_t> nodes) {
    const bool triangle = nodes.size() == 6;
    const CellType type = triangle ? CellType::tri6 : CellType::quad8;
    const Quadrature& gauss = quadrature(triangle ? CellType::wedge15 : CellType::quad8);
    NodalRule rule;
    for (std::size_t q = 0; q < gauss.points.size(); ++q) {
        const ReferencePoint at{gauss.points[q][0], gauss.points[q][1], 0.0};
        const ShapeValues value = shape_values(type, at);
        const Point area = area_at(mesh, nodes, reference_gradient(type, at));
        const double weight = (triangle ? 0.5 : 1.0) * gauss.weights[q];
        for (std::size_t k = 0; k < nodes.size(); ++k) {
            rule.weight[k] += weight * value[k] * length(area);
            for (std::size_t i = 0; i < 3; ++i) rule.area[k][i] += weight * value[k] * area[i];
        }
    }
    return rule;
}

}  // namespace delam
