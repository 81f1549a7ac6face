// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>

#include "base/numbers.hpp"
#include "mesh/faces.hpp"
#include "mesh/selection.hpp"

namespace delam {

namespace {

constexpr double coinciding = 1e-6;  // of the shortest edge

class BoxedPairs {
public:
    BoxedPairs(const Mesh& mesh, const InterfaceGeometry& interface, std::span<const double> lower,
               std::span<const double> upper)
        : mesh_(mesh), interface_(interface), lower_(lower), upper_(upper), axes_(index(mesh.dimension())) {
        double edge = infinite;
        for (const std::int32_t body : {interface.body_a, interface.body_b})
            if (body >= 0 && !mesh.body_cells(body).empty())
                edge = std::min(edge, shortest_edge(mesh, mesh.body_cells(body)));
        if (std::isinf(edge))
            for (std::size_t axis = 0; axis < axes_; ++axis) edge = std::min(edge, 1e-3 * size(axis));
        slack_ = std::isinf(edge) ? 0.0 : coinciding * edge;
    }

    PairsInBox find() const {
        const std::size_t count = interface_.node_b.size();
        std::vector<bool> tip(count, false);
        const auto nodes = index(interface_.nodes_per_face);
        for (std::size_t f = 0; f < interface_.face.size(); f += nodes)
            mark_tips(std::span(interface_.face).subspan(f, nodes), tip);
        if (interface_.face.empty() && count > 0) {
            std::vector<std::int64_t> all(count);
            for (std::size_t p = 0; p < count; ++p) all[p] = static_cast<std::int64_t>(p);
            mark_tips(all, tip);
        }
        PairsInBox found;
        std::vector<bool> chosen(count, false);
        for (std::size_t p = 0; p < count; ++p) {
            if (tip[p] || outside(static_cast<std::int64_t>(p))) continue;
            chosen[p] = true;
            found.pairs.push_back(static_cast<std::int64_t>(p));
        }
        for (std::size_t axis = 0; axis < axes_; ++axis)
            for (const bool upper : {false, true}) add_moved(axis, upper, chosen, found.moved);
        return found;
    }

private:
    // Node b of a pair always lies on the interface; node a may be a control node elsewhere.
    double at(std::int64_t pair, std::size_t axis) const { return mesh_.node(interface_.node_b[index(pair)])[axis]; }
    // Returns how far the pair lies beyond a side of the box; < 0: inside of it.
    double beyond(std::int64_t pair, std::size_t axis, bool upper) const {
        return upper ? at(pair, axis) - upper_[axis] : lower_[axis] - at(pair, axis);
    }
    double size(std::size_t axis) const {
        double least = infinite, most = -infinite;
        for (std::int64_t p = 0; p < interface_.pair_count(); ++p) {
            least = std::min(least, at(p, axis));
            most = std::max(most, at(p, axis));
        }
        return most > least ? most - least : infinite;
    }
    bool outside(std::int64_t pair) const {
        for (std::size_t axis = 0; axis < axes_; ++axis)
            if (beyond(pair, axis, false) > slack_ || beyond(pair, axis, true) > slack_) return true;
        return false;
    }
    // Marks, of pairs that belong together, those on a side of the box beyond which others lie.
    void mark_tips(std::span<const std::int64_t> together, std::vector<bool>& tip) const {
        for (std::size_t axis = 0; axis < axes_; ++axis)
            for (const bool upper : {false, true}) {
                const auto past = [&](std::int64_t p) { return beyond(p, axis, upper) > slack_; };
                if (std::none_of(together.begin(), together.end(), past)) continue;
                for (const std::int64_t p : together)
                    if (std::abs(beyond(p, axis, upper)) <= slack_) tip[index(p)] = true;
            }
    }
    // A face with chosen pairs and with pairs beyond the side, but with none on it.
    void add_moved(std::size_t axis, bool upper, const std::vector<bool>& chosen, std::vector<MovedEnd>& moved) const {
        const auto nodes = index(interface_.nodes_per_face);
        double farthest = 0.0;
        for (std::size_t f = 0; f < interface_.face.size(); f += nodes) {
            const auto face = std::span(interface_.face).subspan(f, nodes);
            double next = infinite;
            bool cut = false, on = false;
            for (const std::int64_t p : face) {
                const double distance = beyond(p, axis, upper);
                if (distance > slack_) next = std::min(next, distance);
                if (distance < -slack_ && chosen[index(p)]) cut = true;
                if (std::abs(distance) <= slack_) on = true;
            }
            if (cut && !on && !std::isinf(next)) farthest = std::max(farthest, next);
        }
        const double end = upper ? upper_[axis] : lower_[axis];
        if (farthest > 0.0) moved.push_back({axis, upper, end, upper ? end + farthest : end - farthest});
    }

    const Mesh& mesh_;
    const InterfaceGeometry& interface_;
    std::span<const double> lower_;
    std::span<const double> upper_;
    std::size_t axes_;
    double slack_ = 0.0;
};

}  // namespace

PairsInBox find_pairs(const Mesh& mesh, std::int64_t interface, std::span<const double> lower,
                      std::span<const double> upper) {
    return BoxedPairs(mesh, mesh.interfaces()[index(interface)], lower, upper).find();
}

}  // namespace delam
