// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/turned/slide_paths.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include "base/numbers.hpp"
#include "mesh/points.hpp"

namespace delam {

namespace {

// Returns the point of the segment from 0 to `end` that is nearest to x, as a share of the segment.
double nearest(const Vector3& x, const Vector3& end) {
    const double square = dot(end, end);
    return square > 0.0 ? std::clamp(dot(x, end) / square, 0.0, 1.0) : 0.0;
}

}  // namespace

SlidePaths::SlidePaths(const Mesh& mesh, const InterfaceGeometry& interface)
    : weight_(interface.weight),
      spacing_(interface.node_a.size(), std::numeric_limits<double>::infinity()),
      neighbours_(interface.node_a.size()) {
    for (const std::int64_t node : interface.node_b) {
        const std::span<const double> at = mesh.node(node);
        std::copy(at.begin(), at.end(), place_.emplace_back(Vector3{}).begin());
    }
    for (std::size_t f = 0; f < interface.face.size(); f += index(interface.nodes_per_face))
        for (std::size_t i = f; i < f + index(interface.nodes_per_face); ++i)
            for (std::size_t j = f; j < f + index(interface.nodes_per_face); ++j)
                if (interface.face[i] != interface.face[j])
                    neighbours_[index(interface.face[i])].push_back(index(interface.face[j]));
    for (std::size_t p = 0; p < neighbours_.size(); ++p) {
        std::vector<std::size_t>& of = neighbours_[p];
        std::sort(of.begin(), of.end());
        of.erase(std::unique(of.begin(), of.end()), of.end());
        for (const std::size_t q : of) {
            Vector3 d = place_[q];
            for (std::size_t k = 0; k < 3; ++k) d[k] -= place_[p][k];
            spacing_[p] = std::min(spacing_[p], length(d));
        }
    }
}

std::vector<SlidePaths::Part> SlidePaths::parts(std::size_t pair, const Vector3& slide, double sign) const {
    const double spacing = spacing_[pair];
    Vector3 end = slide;
    for (double& x : end) x *= sign;
    std::vector<Part> parts;
    std::set<std::size_t> met{pair};
    std::vector<std::size_t> front{pair};
    double sum = 0.0;
    Vector3 change{};
    while (!front.empty()) {
        const std::size_t p = front.back();
        front.pop_back();
        Vector3 from = place_[p];
        for (std::size_t k = 0; k < 3; ++k) from[k] -= place_[pair][k];
        const double share = nearest(from, end);
        for (std::size_t k = 0; k < 3; ++k) from[k] -= share * end[k];
        const double near = 1.0 - dot(from, from) / (spacing * spacing);
        if (!(near > 0.0)) continue;
        Part part{p, weight_[p] * near * near, {}};
        for (std::size_t k = 0; k < 3; ++k)
            part.slope[k] = 4.0 * weight_[p] * near * sign * share * from[k] / (spacing * spacing);
        sum += part.weight;
        for (std::size_t k = 0; k < 3; ++k) change[k] += part.slope[k];
        parts.push_back(part);
        for (const std::size_t q : neighbours_[p])
            if (met.insert(q).second) front.push_back(q);
    }
    for (Part& part : parts) {
        part.weight /= sum;
        for (std::size_t k = 0; k < 3; ++k) part.slope[k] = (part.slope[k] - part.weight * change[k]) / sum;
    }
    return parts;
}

SlidePaths::Path SlidePaths::along(std::size_t pair, const Vector3& slide) const {
    return {parts(pair, slide, 1.0), parts(pair, slide, -1.0)};
}

}  // namespace delam
