// SPDX-License-Identifier: BSD-3-Clause
//
// Two bodies whose meshes do not match: each node p of b's faces is paired with a mean over a's faces (dual mortar
// method: B. Wohlmuth, SIAM J. Numer. Anal. 38, 2000),
//
//   u_a,p = sum_e c_pe l_pe(u_a),   l_pe(v): coefficient of N_p in the L2 projection of v onto the N_q of a face e of
//   b, c_pe = int_e N_p / int N_p.
//
// Linear displacements pass exactly, because the projections leave them as they are. So does a uniform traction t: b
// takes the forces t int N_p, and a takes t sum_p int N_p u_a,p = t int u_a, since a projection keeps the integral.
// The integrals run over the segments in which a face of b meets one face of a.
#include "mesh/pairing/mortar_interface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "mesh/pairing/interfaces.hpp"
#include "mesh/pairing/unmatched_faces.hpp"
#include "mesh/points.hpp"

namespace delam {

namespace {

// Gauss points on an edge, and along each side of a triangle. Shape functions are polynomials on a segment if the maps
// of both faces are affine: with these points the integrals of linear and of quadratic ones are exact.
constexpr int points_linear = 3, points_quadratic = 5, most_points = 20;
// Otherwise they are rational, and the error falls about as the distortion to the power of twice the points. (Measured,
// as unit/test_mortar prints it: uniform traction between hex8 whose tangents vary by a quarter; the 11 points that
// follow leave 1.4e-13 of the force, 8 leave 3e-11, 16 leave 3e-15. Half and twice of this error change
// those of distorted cells within 2e-13.)
constexpr double integral_error = 1e-12;
// Weights of a tie below this are rounding of projections of size 1: ten times what those of matching faces leave.
// (Measured by verify/bench/constants.py with unit_test_mortar and case_test_unmatched, of this and the next three:
// half and twice, for `covered` of what may be missing, make the same interfaces.)
constexpr double rounded = 1e-13;
// Segments below this part of a face are rounding of its corners.
constexpr double no_area = 1e-12;
// Below this part of the area around a node int N_p is zero, as at corners of tet10; of other cells it is -1/12 and
// more.
constexpr double no_integral = 1e-6;
// Segments that leave more than the rest of a face without a partner leave a hole. (Measured in unit/test_mortar, flat
// and on arcs: 1 to 1.007 of the linear pieces of a face.)
constexpr double covered = 0.99;
// Work for the segments of a face, for poll_cancel. (Measured on hex8, 3,600 faces on 2,500: four to five times that of
// add_projected_interface.)
constexpr std::int64_t segments_work = 4 * face_work;

struct Gauss {
    std::vector<double> point, weight;  // on [0, 1]
};

// Roots of the Legendre polynomial by Newton's method.
Gauss gauss(int n) {
    Gauss rule;
    for (int i = 0; i < n; ++i) {
        double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 0.0;
        for (int step = 0; step < 20; ++step) {
            double before = 1.0, value = x;
            for (int k = 2; k <= n; ++k)
                before = std::exchange(value, ((2 * k - 1) * x * value - (k - 1) * before) / k);
            slope = n * (x * value - before) / (x * x - 1.0);
            x -= value / slope;
        }
        rule.point.push_back(0.5 * (1.0 - x));
        rule.weight.push_back(1.0 / ((1.0 - x * x) * slope * slope));
    }
    return rule;
}

int gauss_points(const Mesh& mesh, const BoundaryFace& a, const BoundaryFace& b) {
    const int exact = a.middle().empty() && b.middle().empty() ? points_linear : points_quadratic;
    const double varies = std::clamp(std::max(distortion(mesh, a), distortion(mesh, b)), integral_error, 0.9);
    return std::clamp(static_cast<int>(std::ceil(1.0 + 0.5 * std::log(integral_error) / std::log(varies))), exact,
                      most_points);
}

// A symmetric positive definite matrix of a face's nodes, at most eight.
class FaceMatrix {
public:
    double& operator()(std::size_t p, std::size_t q) { return value_[p][q]; }
    // Makes A = L L^T of the lower triangle; false: not positive definite.
    bool factor(std::size_t size) {
        size_ = size;
        for (std::size_t j = 0; j < size; ++j) {
            const double whole = value_[j][j];
            for (std::size_t i = j; i < size; ++i) {
                for (std::size_t k = 0; k < j; ++k) value_[i][j] -= value_[i][k] * value_[j][k];
                if (i == j && !(value_[j][j] > 1e-12 * whole)) return false;
                value_[i][j] = i == j ? std::sqrt(value_[j][j]) : value_[i][j] / value_[j][j];
            }
        }
        return true;
    }
    void solve(std::span<double> x) const {
        for (std::size_t i = 0; i < size_; ++i) {
            for (std::size_t k = 0; k < i; ++k) x[i] -= value_[i][k] * x[k];
            x[i] /= value_[i][i];
        }
        for (std::size_t i = size_; i-- > 0;) {
            for (std::size_t k = i + 1; k < size_; ++k) x[i] -= value_[k][i] * x[k];
            x[i] /= value_[i][i];
        }
    }

private:
    std::array<std::array<double, most_face_nodes>, most_face_nodes> value_{};
    std::size_t size_ = 0;
};

// The projections l_pe of one face e of b.
class FaceProjection {
public:
    explicit FaceProjection(const BoundaryFace& face) : face_(face), integral_(face.all().size(), 0.0) {}

    void add(const FacePoint& on_b, const BoundaryFace& below, const FacePoint& on_a, double weight) {
        const std::size_t nodes = integral_.size();
        area_ += weight;
        for (std::size_t p = 0; p < nodes; ++p) {
            const double own = weight * on_b.weight[p];
            integral_[p] += own;
            for (std::size_t q = 0; q < nodes; ++q) mass_(p, q) += own * on_b.weight[q];
        }
        for (std::size_t k = 0; k < below.all().size(); ++k) {
            if (on_a.weight[k] == 0.0) continue;
            std::vector<double>& moment = moment_[below.node[k]];
            moment.resize(nodes, 0.0);
            for (std::size_t p = 0; p < nodes; ++p) moment[p] += weight * on_b.weight[p] * on_a.weight[k];
        }
    }
    // False: the segments cover too little of the face to determine the projections.
    bool solve() {
        if (!mass_.factor(integral_.size())) return false;
        for (auto& [node, moment] : moment_) mass_.solve(moment);
        return true;
    }
    const BoundaryFace& face() const { return face_; }
    double area() const { return area_; }
    double integral(std::size_t p) const { return integral_[p]; }
    // [nodes of a][nodes of e]: l_pe(N_i), after solve().
    const std::map<std::int64_t, std::vector<double>>& coefficients() const { return moment_; }

private:
    BoundaryFace face_;
    double area_ = 0.0;
    std::vector<double> integral_;  // int_e N_p
    FaceMatrix mass_;               // int_e N_p N_q
    std::map<std::int64_t, std::vector<double>> moment_;
};

// Adds the segments of an edge of the plane.
void add_segments_of_edge(const Mesh& mesh, const UnmatchedFaces& faces, FaceProjection& projection) {
    const BoundaryFace& edge = projection.face();
    std::vector<double> cut{-1.0, 1.0};
    for (const std::size_t f : faces.ground().meeting(box_of(mesh, edge, 0.0)))
        for (const std::int64_t node : faces.ground().face(f).corner()) {
            const FacePoint foot = closest_point(mesh, edge, position(mesh, node));
            cut.push_back(std::clamp(foot.weight[1] - foot.weight[0], -1.0, 1.0));
        }
    std::sort(cut.begin(), cut.end());
    for (std::size_t k = 0; k + 1 < cut.size(); ++k) {
        const double from = cut[k], length = cut[k + 1] - from;
        if (length < no_area) continue;
        const FacePoint middle = point_of_edge(mesh, edge, from + 0.5 * length);
        const auto found = faces.ground().under(middle.place, middle.normal);
        if (!found) continue;
        const BoundaryFace& below = faces.ground().face(found->face);
        const Gauss rule = gauss(gauss_points(mesh, below, edge));
        for (std::size_t q = 0; q < rule.point.size(); ++q) {
            const FacePoint on_b = point_of_edge(mesh, edge, from + length * rule.point[q]);
            projection.add(on_b, below, closest_point(mesh, below, on_b.place), length * rule.weight[q] * on_b.stretch);
        }
    }
}

using Flat = std::array<double, 2>;
double area_of(const Flat& a, const Flat& b, const Flat& c) {
    return 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
}

// The plane through the middle of a face of b.
class Plane {
public:
    Plane(const Mesh& mesh, const BoundaryFace& face) : normal_(area_vector(mesh, face.all())) {
        area_ = length(normal_);
        for (double& n : normal_) n /= area_;
        for (const std::int64_t node : face.corner())
            for (std::size_t i = 0; i < 3; ++i)
                origin_[i] += mesh.node(node)[i] / static_cast<double>(face.corner().size());
        along_[0] = position(mesh, face.node[1]) - position(mesh, face.node[0]);
        const double out = dot(along_[0], normal_);
        for (std::size_t i = 0; i < 3; ++i) along_[0][i] -= out * normal_[i];
        const double size = length(along_[0]);
        for (double& x : along_[0]) x /= size;
        along_[1] = cross(normal_, along_[0]);
    }
    const Point& normal() const { return normal_; }
    double area() const { return area_; }
    Flat flat(const Point& x) const { return {dot(x - origin_, along_[0]), dot(x - origin_, along_[1])}; }
    Point lifted(const Flat& x) const {
        Point p = origin_;
        for (std::size_t i = 0; i < 3; ++i) p[i] += x[0] * along_[0][i] + x[1] * along_[1][i];
        return p;
    }
    // The corners of a face, counter-clockwise seen along the normal.
    std::vector<Flat> polygon(const Mesh& mesh, const BoundaryFace& face) const {
        std::vector<Flat> corners;
        for (const std::int64_t node : face.corner()) corners.push_back(flat(position(mesh, node)));
        if (area_of(corners[0], corners[1], corners[2]) < 0.0) std::reverse(corners.begin(), corners.end());
        return corners;
    }

private:
    Point normal_, origin_{};
    std::array<Point, 2> along_{};
    double area_ = 0.0;
};

// The part of a polygon inside a convex one (I. Sutherland, G. Hodgman, Commun. ACM 17, 1974).
std::vector<Flat> clipped(std::vector<Flat> polygon, const std::vector<Flat>& by) {
    for (std::size_t k = 0; k < by.size() && !polygon.empty(); ++k) {
        const Flat& from = by[k];
        const Flat& to = by[(k + 1) % by.size()];
        std::vector<Flat> left;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Flat& x = polygon[i];
            const Flat& y = polygon[(i + 1) % polygon.size()];
            const double at_x = area_of(from, to, x), at_y = area_of(from, to, y);
            if (at_x >= 0.0) left.push_back(x);
            if ((at_x < 0.0) == (at_y < 0.0)) continue;
            const double part = at_x / (at_x - at_y);
            left.push_back({x[0] + part * (y[0] - x[0]), x[1] + part * (y[1] - x[1])});
        }
        polygon = std::move(left);
    }
    return polygon;
}

// Adds the segments of a face in space: its corners and those of a's faces, projected onto one plane, meet in polygons.
void add_segments_of_face(const Mesh& mesh, const UnmatchedFaces& faces, FaceProjection& projection) {
    const BoundaryFace& face = projection.face();
    const Plane plane(mesh, face);
    const std::vector<Flat> own = plane.polygon(mesh, face);
    for (const std::size_t f : faces.ground().meeting(box_of(mesh, face, 0.0))) {
        const BoundaryFace& below = faces.ground().face(f);
        const Point normal = area_vector(mesh, below.all());
        if (dot(normal, plane.normal()) > -0.5 * length(normal)) continue;
        const std::vector<Flat> segment = clipped(plane.polygon(mesh, below), own);
        const Gauss rule = gauss(gauss_points(mesh, below, face));
        for (std::size_t k = 1; k + 1 < segment.size(); ++k) {
            const double area = area_of(segment[0], segment[k], segment[k + 1]);
            if (area < no_area * plane.area()) continue;
            for (std::size_t i = 0; i < rule.point.size(); ++i)
                for (std::size_t j = 0; j < rule.point.size(); ++j) {
                    // x = x_0 + s (x_k - x_0) + s t (x_k+1 - x_k), dA = 2 area s ds dt
                    const double s = rule.point[i], t = rule.point[j];
                    Flat at{};
                    for (std::size_t c = 0; c < 2; ++c)
                        at[c] = segment[0][c] + s * (segment[k][c] - segment[0][c]) +
                                s * t * (segment[k + 1][c] - segment[k][c]);
                    const FacePoint on_b = closest_point(mesh, face, plane.lifted(at));
                    const FacePoint on_a = closest_point(mesh, below, on_b.place);
                    // Faces of another sheet of a; corners alone are known to be within reach.
                    if (length(on_b.place - on_a.place) > 2.0 * faces.ground().reach()) continue;
                    projection.add(on_b, below, on_a,
                                   2.0 * area * s * rule.weight[i] * rule.weight[j] / dot(on_b.normal, plane.normal()));
                }
        }
    }
}

// Removes weights that are rounding; the others still sum to 1.
Tie rounded_tie(const std::map<std::int64_t, double>& weights) {
    Tie tie;
    double sum = 0.0;
    std::size_t largest = 0;
    for (const auto& [node, weight] : weights) {
        if (std::abs(weight) <= rounded) continue;
        tie.emplace_back(node, weight);
        sum += weight;
        if (std::abs(weight) > std::abs(tie[largest].second)) largest = tie.size() - 1;
    }
    tie[largest].second += 1.0 - sum;
    return tie;
}

}  // namespace

std::map<std::int64_t, Tie> mortar_ties(const Mesh& mesh, const UnmatchedFaces& faces) {
    std::vector<FaceProjection> projections;
    std::map<std::int64_t, std::pair<double, double>> around;  // int N_p and the area of the faces around a node
    for (const BoundaryFace& face : faces.on()) {
        poll_cancel("pairs", segments_work);
        FaceProjection& own = projections.emplace_back(face);
        if (mesh.dimension() == 2)
            add_segments_of_edge(mesh, faces, own);
        else
            add_segments_of_face(mesh, faces, own);
        if (own.area() < covered * length(area_vector(mesh, face.all())) || !own.solve())
            faces.refuse_partial(face, position(mesh, face.node[0]));
        for (std::size_t p = 0; p < face.all().size(); ++p) {
            around[face.node[p]].first += own.integral(p);
            around[face.node[p]].second += own.area();
        }
    }
    std::map<std::int64_t, std::map<std::int64_t, double>> weights;
    for (const FaceProjection& own : projections)
        for (std::size_t p = 0; p < own.face().all().size(); ++p) {
            const std::int64_t node = own.face().node[p];
            const auto [integral, area] = around[node];
            const double share =
                std::abs(integral) > no_integral * area ? own.integral(p) / integral : own.area() / area;
            for (const auto& [carrier, coefficient] : own.coefficients())
                weights[node][carrier] += share * coefficient[p];
        }
    std::map<std::int64_t, Tie> ties;
    for (const auto& [node, of] : weights) ties.emplace(node, rounded_tie(of));
    return ties;
}

std::int64_t add_mortar_interface(Mesh& mesh, std::int32_t label_a, std::int32_t label_b, double gap) {
    const UnmatchedFaces faces(mesh, label_a, label_b, gap, LeavingFaces::take);
    return faces.append(mesh, mortar_ties(mesh, faces));
}

}  // namespace delam
