// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/selection.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.hpp"
#include "delam/delam.h"
#include "mesh/faces.hpp"

namespace delam {

namespace {

// A share of the mesh's size: nodes written with a few digits still lie on the box they should.
constexpr double widening = 1e-9;

void check(const Mesh& mesh, std::int32_t body, std::span<const double> lower, std::span<const double> upper) {
    if (body < -1 || body >= mesh.body_count())
        fail(DELAM_ERROR_ARGUMENT, "body index ", body, ": must be in -1..", mesh.body_count() - 1);
    for (std::size_t i = 0; i < at(mesh.dimension()); ++i)
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

    // Axes along which the box cuts this face. A face that is flat along an axis is never cut there: it is in or out,
    // with the slack; so a box may be a mere plane, and slack adds nothing to a patch. False: the face is outside.
    bool look_at(std::span<const std::int64_t> nodes) {
        cut_.fill(false);
        for (std::size_t i = 0; i < at(mesh_.dimension()); ++i) {
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
        weight[at(nodes[0])] += length * (1.0 - middle);
        weight[at(nodes[1])] += length * middle;
    }

    // Linear functions are integrated exactly over a triangle by their mean at the corners; the clipped polygon
    // is a fan.
    void add_triangle(const std::array<std::int64_t, 3>& nodes, double factor, std::span<double> weight) const {
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
            const Vertex& a = polygon[0];
            const Vertex& b = polygon[k - 1];
            const Vertex& c = polygon[k];
            const double area = measure(a, b, c);
            if (!(area > sliver * whole)) continue;
            for (std::size_t i = 0; i < 3; ++i)
                weight[at(nodes[i])] += factor * area * (a.share[i] + b.share[i] + c.share[i]) / 3.0;
        }
    }

private:
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
    for (std::int64_t n = 0; n < mesh.node_count(); ++n) {
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

    std::vector<double> weight(at(mesh.node_count()), 0.0);
    Window window(mesh, lower, upper);
    const double cosine = std::sqrt(0.5) - 1e-9;  // 45 degrees, the limit included
    for (std::int32_t b = body < 0 ? 0 : body; b < (body < 0 ? mesh.body_count() : body + 1); ++b) {
        for (const BoundaryFace& face : boundary_faces(mesh, b)) {
            const auto nodes = std::span(face.node).first(at(face.nodes));
            if (!window.look_at(nodes)) continue;
            const auto area = area_vector(mesh, nodes);
            double along = 0.0;
            for (std::size_t i = 0; i < direction.size(); ++i) along += area[i] * (direction[i] / length);
            if (along < cosine * std::hypot(area[0], area[1], area[2])) continue;
            if (face.nodes == 2) window.add_edge(nodes, weight);
            if (face.nodes == 3) window.add_triangle({nodes[0], nodes[1], nodes[2]}, 1.0, weight);
            if (face.nodes == 4) {  // the mean of both ways to halve it: no corner is preferred
                window.add_triangle({nodes[0], nodes[1], nodes[2]}, 0.5, weight);
                window.add_triangle({nodes[0], nodes[2], nodes[3]}, 0.5, weight);
                window.add_triangle({nodes[0], nodes[1], nodes[3]}, 0.5, weight);
                window.add_triangle({nodes[1], nodes[2], nodes[3]}, 0.5, weight);
            }
        }
    }
    Patch patch;
    for (std::int64_t n = 0; n < mesh.node_count(); ++n) {
        if (!(weight[at(n)] > 0.0)) continue;
        patch.nodes.push_back(n);
        patch.weights.push_back(weight[at(n)]);
    }
    return patch;
}

}  // namespace delam
