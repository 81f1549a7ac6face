// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/rule/pair_links.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "base/numbers.hpp"
#include "mesh/cell_type.hpp"
#include "mesh/points.hpp"

namespace delam {

namespace {

// Links of a pair are parallel if the determinant of M is below this part of the square of its trace: the square of
// half the sine of their angle, 2e-5 rad. Half and twice give the same sums in unit/test_pair_links.
constexpr double parallel = 1e-10;

// A face without padding, by its pairs; a side k lies between the corners k and k + 1.
struct Face {
    std::vector<std::int64_t> corner, middle;
    std::int64_t centre = -1;

    std::size_t next(std::size_t k) const { return (k + 1) % corner.size(); }
    std::size_t previous(std::size_t k) const { return (k + corner.size() - 1) % corner.size(); }
};

Face face_of(std::span<const std::int64_t> pairs, const FaceRow& row) {
    const std::size_t corners = index(row.corners);
    Face face;
    for (std::size_t k = 0; k < corners; ++k) {
        if (pairs[k] == pairs[(k + 1) % corners]) continue;
        face.corner.push_back(pairs[k]);
        face.middle.push_back(pairs[corners + k]);
    }
    if (pairs.size() > 2 * corners && face.corner.size() == corners) face.centre = pairs[2 * corners];
    return face;
}

// Collects pairs of pairs, each once.
class Links {
public:
    explicit Links(const InterfaceGeometry& interface) {
        const FaceRow& row = face_row(3, index(interface.nodes_per_face));
        const std::size_t nodes = index(row.nodes);
        for (std::size_t f = 0; f + nodes <= interface.face.size(); f += nodes)
            add(face_of(std::span(interface.face).subspan(f, nodes), row));
    }
    const std::set<std::pair<std::int64_t, std::int64_t>>& all() const { return links_; }

private:
    struct Side {
        std::size_t face, side;
    };

    void link(std::int64_t p, std::int64_t q) {
        if (p >= 0 && q >= 0 && p != q) links_.insert(std::minmax(p, q));
    }
    void add(Face face) {
        const std::size_t corners = face.corner.size(), own = faces_.size();
        for (std::size_t k = 0; k < corners; ++k) link(face.corner[k], face.corner[face.next(k)]);
        for (std::size_t k = 0; corners == 4 && k < 2; ++k) link(face.middle[k], face.middle[k + 2]);
        faces_.push_back(std::move(face));
        for (std::size_t k = 0; k < corners; ++k) {
            const auto [other, first] = across_.try_emplace(faces_[own].middle[k], Side{own, k});
            if (!first) join(other->second, {own, k});
        }
    }
    // Two faces with a common side: each other side of one and the parallel one of the other. In quadrilaterals both
    // begin at the same end of the common side, in triangles, which form a parallelogram, at different ends.
    void join(Side a, Side b) {
        const Face &f = faces_[a.face], &g = faces_[b.face];
        if (f.corner.size() != g.corner.size()) return;
        link(f.centre, g.centre);
        const bool turned = f.corner[a.side] != g.corner[b.side];  // the ends of the side come in the other order
        const std::size_t at_begin = g.previous(b.side), at_end = g.next(b.side);
        const bool swapped = turned == (f.corner.size() == 4);
        link(f.middle[f.previous(a.side)], g.middle[swapped ? at_end : at_begin]);
        link(f.middle[f.next(a.side)], g.middle[swapped ? at_begin : at_end]);
    }

    std::vector<Face> faces_;
    std::map<std::int64_t, Side> across_;  // by the pair in the middle of a side
    std::set<std::pair<std::int64_t, std::int64_t>> links_;
};

// Fits gradients in the tangent plane of a pair: grad f = M^-1 sum r (f(x + r) - f(x)), M = sum r r^T.
class Fit {
public:
    explicit Fit(const double* tangents) : tangents_(tangents) {}
    void add(const Point& reach) {
        const auto [s, t] = in_plane(reach);
        m_[0] += s * s, m_[1] += s * t, m_[2] += t * t;
    }
    Point factor(const Point& reach) const {
        const auto [s, t] = in_plane(reach);
        const double det = m_[0] * m_[2] - m_[1] * m_[1], trace = m_[0] + m_[2];
        // Links in one direction tell the gradient along it.
        if (!(det > parallel * trace * trace)) return in_space(s / trace, t / trace);
        return in_space((m_[2] * s - m_[1] * t) / det, (m_[0] * t - m_[1] * s) / det);
    }

private:
    std::pair<double, double> in_plane(const Point& r) const {
        double s = 0.0, t = 0.0;
        for (std::size_t i = 0; i < 3; ++i) s += tangents_[i] * r[i], t += tangents_[3 + i] * r[i];
        return {s, t};
    }
    Point in_space(double s, double t) const {
        Point r{};
        for (std::size_t i = 0; i < 3; ++i) r[i] = s * tangents_[i] + t * tangents_[3 + i];
        return r;
    }

    const double* tangents_;
    std::array<double, 3> m_{};
};

}  // namespace

std::vector<PairLink> pair_links(const Mesh& mesh, const InterfaceGeometry& interface) {
    std::vector<PairLink> made;
    if (mesh.dimension() != 3 || interface.nodes_per_face <= 4) return made;
    const Links links(interface);
    std::vector<Fit> fits;
    for (std::size_t p = 0; p < interface.node_b.size(); ++p) fits.emplace_back(&interface.frame[9 * p + 3]);
    const auto reach = [&](std::int64_t p, std::int64_t q) {
        return position(mesh, interface.node_b[index(q)]) - position(mesh, interface.node_b[index(p)]);
    };
    for (const auto& [p, q] : links.all()) {
        fits[index(p)].add(reach(p, q));
        fits[index(q)].add(reach(q, p));
    }
    for (const auto& [p, q] : links.all()) {
        const Point at_p = fits[index(p)].factor(reach(p, q)), at_q = fits[index(q)].factor(reach(q, p));
        PairLink link{p, q, {}};
        for (std::size_t i = 0; i < 3; ++i)
            link.area[i] = interface.weight[index(p)] * at_p[i] - interface.weight[index(q)] * at_q[i];
        made.push_back(link);
    }
    return made;
}

}  // namespace delam
