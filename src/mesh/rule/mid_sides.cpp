// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/rule/mid_sides.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "base/cancel_scope.hpp"
#include "base/numbers.hpp"
#include "mesh/points.hpp"

namespace delam {

namespace {

// s on the sides of undistorted faces, powers of two, so that jumps have no rounding of their own. A face then has at
// each corner 1/36 of its area (8 nodes; with 1/8 it would be negative, with 1/2 it is 1/12) or 1/15 (6 nodes; with
// 1/16 it is 1/27, with 1/4 it is 1/9). Smaller s make the moment of an opening that varies over a face more accurate.
constexpr double share_of_8 = 0.25, share_of_6 = 0.125;
// Corners with less than this part of the area around them get larger s. It bounds the weights of distorted faces: the
// corners of undistorted ones have 1/36 and more. (Measured with unit/test_mid_sides,
// whose mid-side nodes are up to .24 off: half and twice make the same interfaces.)
constexpr double least_corner = 0.01;
// Sides that deviate from a straight one with its node in the middle by less than this part of their length do so by
// rounding: their pairs are at the node, to the last digit. (Coordinates of 16 digits deviate by 3e-13 on sides of a
// thousandth of the scene; half and twice make the same interfaces in unit/test_mid_sides.)
constexpr double straight_side = 1e-12;
// So often s is doubled at most. a = s / (1 + 2s) is then within 1e-3 of 1/2, with which corners have the weights of
// linear faces. (Two suffice in unit/test_mid_sides, so that half and twice make the same interfaces; none fails
// there.)
constexpr int most_doublings = 8;

// The nodes of a mesh and those that follow when an interface is appended.
struct ExtendedNodes {
    const Mesh& mesh;
    std::vector<NodeTie> ties;
    std::vector<double> places;

    Point place(std::int64_t node) const {
        const std::int64_t known = mesh.node_count();
        if (node < known) return position(mesh, node);
        Point p{};
        const auto dim = index(mesh.dimension());
        std::copy_n(&places[index(node - known) * dim], dim, p.begin());
        return p;
    }
    // Appends a tied node that has the value u_m + s (2 u_m - u_c - u_d).
    std::int64_t add(std::int64_t m, std::int64_t c, std::int64_t d, double s) {
        const std::int64_t known = mesh.node_count(), made = known + static_cast<std::int64_t>(ties.size());
        std::map<std::int64_t, double> sum;
        for (const auto& [node, factor] : {std::pair(m, 1.0 + 2.0 * s), std::pair(c, -s), std::pair(d, -s)}) {
            if (node < known) {
                sum[node] += factor;
                continue;
            }
            for (const auto& [carrier, weight] : ties[index(node - known)].of) sum[carrier] += factor * weight;
        }
        NodeTie tie{made, {}};
        for (const auto& [carrier, weight] : sum)
            if (weight != 0.0) tie.of.emplace_back(carrier, weight);
        const Point at = place(m), first = at - place(c), second = at - place(d);
        Point bend{};
        for (std::size_t i = 0; i < 3; ++i) bend[i] = first[i] + second[i];
        if (length(bend) <= straight_side * length(first - second)) bend = {};
        for (std::size_t i = 0; i < index(mesh.dimension()); ++i) places.push_back(at[i] + s * bend[i]);
        ties.push_back(std::move(tie));
        return made;
    }
};

}  // namespace

void MidSides::add(std::span<const std::int64_t> nodes, std::span<const std::int64_t> pairs, std::size_t corners) {
    if (corners < 3 || pairs.size() != 2 * corners) return;
    for (std::size_t k = 0; k < corners; ++k) {
        const std::int64_t pair = pairs[corners + k];
        if (pair < 0) continue;
        MidSide& side = side_[index(pair)];
        side.pair = pair;
        side.corner = {pairs[k], pairs[(k + 1) % corners]};
        side.node = {nodes[k], nodes[(k + 1) % corners]};
        side.share = std::max(side.share, corners == 3 ? share_of_6 : share_of_8);
    }
}

NodalRule MidSides::rule(const Mesh& mesh, std::span<const std::int64_t> nodes, std::span<const std::int64_t> pairs,
                         std::size_t corners) const {
    const bool without_centre = corners > 2 && nodes.size() == 2 * corners;
    NodalRule rule = without_centre ? shape_integrals(mesh, nodes) : nodal_rule(mesh, nodes);
    for (std::size_t k = 0; corners > 2 && k < corners && corners + k < nodes.size(); ++k) {
        const std::size_t m = corners + k;
        const double s = pairs[m] < 0 ? 0.0 : side_[index(pairs[m])].share;
        if (s == 0.0) continue;
        const double a = s / (1.0 + 2.0 * s);
        for (const std::size_t c : {k, (k + 1) % corners}) {
            rule.weight[c] += a * rule.weight[m];
            for (std::size_t i = 0; i < 3; ++i) rule.area[c][i] += a * rule.area[m][i];
        }
        rule.weight[m] *= 1.0 - 2.0 * a;
        for (std::size_t i = 0; i < 3; ++i) rule.area[m][i] *= 1.0 - 2.0 * a;
    }
    return rule;
}

bool MidSides::widen(std::span<const double> weight, std::span<const double> around) {
    if (widened_ == most_doublings) return false;
    bool any = false;
    for (MidSide& side : side_) {
        const bool light = std::any_of(side.corner.begin(), side.corner.end(), [&](std::int64_t c) {
            return c >= 0 && weight[index(c)] < least_corner * around[index(c)];
        });
        if (side.share == 0.0 || !light) continue;
        side.share *= 2.0;
        any = true;
    }
    ++widened_;
    return any;
}

std::vector<MidSide> MidSides::list() const {
    std::vector<MidSide> list;
    std::copy_if(side_.begin(), side_.end(), std::back_inserter(list), [](const MidSide& s) { return s.share > 0.0; });
    return list;
}

std::int64_t append_interface(Mesh& mesh, NewInterface interface, std::vector<NodeTie> ties,
                              std::vector<double> places) {
    std::vector<std::int64_t> originals(ties.size(), -1);
    ExtendedNodes nodes{mesh, std::move(ties), std::move(places)};
    for (const MidSide& side : interface.middle) {
        poll_cancel("pairs", 4);
        for (std::vector<std::int64_t>* of_pair : {&interface.geometry.node_a, &interface.geometry.node_b}) {
            const auto corner = [&](std::size_t k) {
                return side.corner[k] < 0 ? side.node[k] : (*of_pair)[index(side.corner[k])];
            };
            const std::int64_t node = (*of_pair)[index(side.pair)];
            originals.push_back(node < mesh.node_count() ? mesh.node_origin(node) : node);
            (*of_pair)[index(side.pair)] = nodes.add(node, corner(0), corner(1), side.share);
        }
    }
    return mesh.append(std::move(interface.geometry), std::move(nodes.ties), nodes.places, originals);
}

void append_interfaces(Mesh& mesh, std::vector<NewInterface> interfaces) {
    const bool tied =
        std::any_of(interfaces.begin(), interfaces.end(), [](const auto& i) { return !i.middle.empty(); });
    if (!tied) {
        std::vector<InterfaceGeometry> plain;
        for (NewInterface& interface : interfaces) plain.push_back(std::move(interface.geometry));
        mesh.append_all(plain);
        return;
    }
    Mesh joined = mesh;
    for (NewInterface& interface : interfaces) append_interface(joined, std::move(interface));
    mesh = std::move(joined);
}

std::int64_t node_of_pair(const Mesh& mesh, std::int64_t node) {
    const std::int64_t original = mesh.node_origin(node);
    const std::vector<NodeTie>& ties = mesh.ties();
    const auto found =
        std::lower_bound(ties.begin(), ties.end(), node, [](const NodeTie& t, std::int64_t n) { return t.node < n; });
    if (original == node || found == ties.end() || found->node != node) return node;
    for (const auto& [carrier, weight] : found->of)
        if (mesh.node_origin(carrier) == original) return carrier;
    return original;
}

}  // namespace delam
