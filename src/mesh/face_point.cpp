// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/face_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>

#include "mesh/faces.hpp"
#include "mesh/points.hpp"
#include "mesh/shape.hpp"

namespace delam {

namespace {

constexpr int most_steps = 60;
constexpr double converged = 1e-14;  // in the reference cell

using Parameters = std::array<double, 2>;

// A face as a map from its reference cell: edges of the plane from [-1,1], faces in space from the triangle or square.
class Chart {
public:
    Chart(const Mesh& mesh, const BoundaryFace& face) : face_(face), edge_(mesh.dimension() == 2) {
        for (const std::int64_t node : face.all()) node_.push_back(position(mesh, node));
        if (!edge_) type_ = face_row(mesh.dimension(), node_.size()).surface;
    }

    bool edge() const { return edge_; }
    std::size_t corners() const { return index(face_.corners); }
    std::size_t nodes() const { return node_.size(); }
    Parameters node(std::size_t k) const {
        if (edge_) return {k == 2 ? 0.0 : k == 1 ? 1.0 : -1.0, 0.0};
        const ReferencePoint& p = reference_nodes(type_)[k];
        return {p[0], p[1]};
    }
    Parameters centre() const {
        if (edge_) return {0.0, 0.0};
        const ReferencePoint& p = delam::centre(type_);
        return {p[0], p[1]};
    }
    bool inside(const Parameters& xi) const {
        constexpr double on_the_edge = 1e-12;  // rounding of parameters of size 1, which Newton's method has found
        if (edge_) return std::abs(xi[0]) <= 1.0 + on_the_edge;
        if (corners() == 3) return xi[0] >= -on_the_edge && xi[1] >= -on_the_edge && xi[0] + xi[1] <= 1.0 + on_the_edge;
        return std::abs(xi[0]) <= 1.0 + on_the_edge && std::abs(xi[1]) <= 1.0 + on_the_edge;
    }

    struct Value {
        std::array<double, most_face_nodes> weight{};
        Point place{};
        std::array<Point, 2> tangent{};  // dx/dxi
    };
    Value operator()(const Parameters& xi) const {
        Value v;
        std::array<Parameters, most_face_nodes> slope{};
        if (edge_) {
            const double t = xi[0];
            const double bend = nodes() == 3 ? 1.0 - t * t : 0.0;
            v.weight = {0.5 * (1.0 - t) - 0.5 * bend, 0.5 * (1.0 + t) - 0.5 * bend, bend};
            const double turn = nodes() == 3 ? t : 0.0;
            slope[0][0] = -0.5 + turn;
            slope[1][0] = 0.5 + turn;
            slope[2][0] = -2.0 * turn;
        } else {
            const ReferencePoint p{xi[0], xi[1], 0.0};
            const ShapeValues n = shape_values(type_, p);
            const ShapeGradient g = reference_gradient(type_, p);
            for (std::size_t a = 0; a < nodes(); ++a) {
                v.weight[a] = n[a];
                slope[a] = {g[2 * a], g[2 * a + 1]};
            }
        }
        for (std::size_t a = 0; a < nodes(); ++a)
            for (std::size_t i = 0; i < 3; ++i) {
                v.place[i] += v.weight[a] * node_[a][i];
                for (std::size_t k = 0; k < 2; ++k) v.tangent[k][i] += slope[a][k] * node_[a][i];
            }
        return v;
    }

    FacePoint point(const Parameters& xi) const {
        const Value v = (*this)(xi);
        FacePoint p;
        double sum = 0.0;
        for (std::size_t a = 0; a < nodes(); ++a) {
            p.weight[a] = std::abs(v.weight[a]) < 1e-12 ? 0.0 : v.weight[a];
            sum += p.weight[a];
        }
        for (std::size_t a = 0; a < nodes(); ++a) {
            p.weight[a] /= sum;
            for (std::size_t i = 0; i < 3; ++i) p.place[i] += p.weight[a] * node_[a][i];
        }
        p.normal = edge_ ? Point{v.tangent[0][1], -v.tangent[0][0], 0.0} : cross(v.tangent[0], v.tangent[1]);
        const double size = length(p.normal);
        for (double& component : p.normal) component /= size;
        p.stretch = size;
        return p;
    }

private:
    const BoundaryFace& face_;
    bool edge_;
    CellType type_ = CellType::tri3;
    std::vector<Point> node_;
};

// Returns the closest point of the straight line between two points of the reference cell: the best of three starting
// points, where it may be curved in space.
Parameters closest_on_line(const Chart& chart, const Parameters& from, const Parameters& to, const Point& x) {
    const Parameters along{to[0] - from[0], to[1] - from[1]};
    const auto on = [&](double t) { return Parameters{from[0] + t * along[0], from[1] + t * along[1]}; };
    std::pair best{std::numeric_limits<double>::infinity(), 0.0};
    constexpr std::array<double, 3> starts{0.5, 0.0, 1.0};
    const bool straight = chart.nodes() == chart.corners();
    for (double t : std::span(starts).first(straight ? 1 : starts.size())) {
        for (int step = 0; step < most_steps; ++step) {
            const Chart::Value v = chart(on(t));
            Point tangent;
            for (std::size_t i = 0; i < 3; ++i) tangent[i] = along[0] * v.tangent[0][i] + along[1] * v.tangent[1][i];
            const double next = std::clamp(t + dot(x - v.place, tangent) / dot(tangent, tangent), 0.0, 1.0);
            const double change = std::abs(next - t);
            t = next;
            if (change <= converged) break;
        }
        best = std::min(best, {length(x - chart(on(t)).place), t});
    }
    return on(best.second);
}

// A stationary point within the face, from one starting point.
std::optional<Parameters> closest_inside(const Chart& chart, Parameters xi, const Point& x) {
    for (int step = 0; step < most_steps; ++step) {
        const Chart::Value v = chart(xi);
        const Point off = x - v.place;
        const double a = dot(v.tangent[0], v.tangent[0]);
        const double b = dot(v.tangent[0], v.tangent[1]);
        const double c = dot(v.tangent[1], v.tangent[1]);
        const double f = dot(off, v.tangent[0]);
        const double g = dot(off, v.tangent[1]);
        const double determinant = a * c - b * b;
        if (!(determinant > 1e-12 * a * c)) return std::nullopt;
        const Parameters change{(c * f - b * g) / determinant, (a * g - b * f) / determinant};
        xi[0] += change[0];
        xi[1] += change[1];
        if (!(std::abs(xi[0]) < 4.0 && std::abs(xi[1]) < 4.0)) return std::nullopt;
        if (std::max(std::abs(change[0]), std::abs(change[1])) <= 10.0 * converged)
            return chart.inside(xi) ? std::optional(xi) : std::nullopt;
    }
    return std::nullopt;
}

}  // namespace

FacePoint point_of_edge(const Mesh& mesh, const BoundaryFace& face, double t) {
    return Chart(mesh, face).point({t, 0.0});
}

double distortion(const Mesh& mesh, const BoundaryFace& face) {
    const Chart chart(mesh, face);
    const auto at_centre = chart(chart.centre()).tangent;
    double most = 0.0;
    for (std::size_t k = 0; k < chart.nodes(); ++k) {
        const auto tangent = chart(chart.node(k)).tangent;
        for (std::size_t i = 0; i < (chart.edge() ? 1U : 2U); ++i)
            most = std::max(most, length(tangent[i] - at_centre[i]) / length(at_centre[i]));
    }
    return most;
}

NormalCone normal_cone(const Mesh& mesh, const BoundaryFace& face) {
    const Chart chart(mesh, face);
    NormalCone cone{chart.point(chart.centre()).normal, 0.0};
    double least = 1.0;
    for (std::size_t k = 0; k < chart.nodes(); ++k) {
        const double cosine = dot(chart.point(chart.node(k)).normal, cone.axis);
        if (!std::isfinite(cosine)) return {cone.axis, std::numbers::pi};
        least = std::min(least, cosine);
    }
    cone.angle = std::acos(std::clamp(least, -1.0, 1.0));
    return cone;
}

FacePoint closest_point(const Mesh& mesh, const BoundaryFace& face, const Point& x) {
    const Chart chart(mesh, face);
    if (chart.edge()) return chart.point(closest_on_line(chart, {-1.0, 0.0}, {1.0, 0.0}, x));
    if (const auto xi = closest_inside(chart, chart.centre(), x)) return chart.point(*xi);
    std::pair best{std::numeric_limits<double>::infinity(), Parameters{}};
    for (std::size_t k = 0; k < chart.corners(); ++k) {
        const Parameters xi = closest_on_line(chart, chart.node(k), chart.node((k + 1) % chart.corners()), x);
        best = std::min(best, {length(x - chart(xi).place), xi});
    }
    return chart.point(best.second);
}

std::vector<FacePoint> inner_points(const Mesh& mesh, const BoundaryFace& face) {
    const Chart chart(mesh, face);
    const Parameters c = chart.centre();
    std::vector<FacePoint> points{chart.point(c)};
    for (const double share : {0.5, 0.998})
        for (std::size_t k = 0; k < chart.nodes(); ++k) {
            const Parameters p = chart.node(k);
            points.push_back(chart.point({c[0] + share * (p[0] - c[0]), c[1] + share * (p[1] - c[1])}));
        }
    return points;
}

}  // namespace delam
