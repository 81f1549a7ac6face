// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/face_gaps.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/cancel_scope.hpp"
#include "base/numbers.hpp"
#include "mesh/faces.hpp"
#include "mesh/points.hpp"

namespace delam {

namespace {

// Part of the mesh's size that is the rounding of coordinates in files. (Measured by verify/bench/constants.py with
// case_test_gaps and case_test_unmatched: half and twice close the same gaps.)
constexpr double seven_digits = 1e-6;
// Cosine of the angle from which on two facets meet at an edge of the body, not on a curved face: 30 degrees, as in a
// circle of 12 facets. Half of it takes coarse circles for polygons, twice lets gaps at edges of 120 degrees be closed.
constexpr double smooth = 0.866;
// Facets of a polygon in a circle cut off arcs of height h^2 / 8 R = h phi / 8, phi being the angle between them; gaps
// between two meshes of it vary by that. The margin is for uneven facets. (The same tests: half and twice of it close
// the same gaps.)
constexpr double arc = 1.1 / 8.0;

struct Facet {
    std::vector<std::int64_t> corner;
    Point normal;       // of unit length
    double edge = 0.0;  // the longest
};

// Plane faces of a body; those with mid-side nodes are curved, and follow an arc.
std::vector<Facet> facets_of(const Mesh& mesh, std::int32_t body) {
    std::vector<Facet> facets;
    for (const BoundaryFace& face : boundary_faces(mesh, body)) {
        poll_cancel("pairs");
        if (!face.middle().empty()) continue;
        Facet own{{face.corner().begin(), face.corner().end()}, area_vector(mesh, face.all())};
        const double area = length(own.normal);
        for (double& n : own.normal) n /= area;
        for (std::size_t k = 0; k < own.corner.size(); ++k)
            own.edge = std::max(own.edge, length(position(mesh, own.corner[(k + 1) % own.corner.size()]) -
                                                 position(mesh, own.corner[k])));
        facets.push_back(std::move(own));
    }
    return facets;
}

// Returns the height of the arcs that the facets about each node cut off; 0 where they are plane.
std::map<std::int64_t, double> arcs_of(const Mesh& mesh, std::int32_t body) {
    const std::vector<Facet> facets = facets_of(mesh, body);
    std::map<std::int64_t, std::vector<const Facet*>> about;
    for (const Facet& facet : facets)
        for (const std::int64_t node : facet.corner) about[node].push_back(&facet);
    std::map<std::int64_t, double> height;
    for (const Facet& facet : facets) {
        double turned = 1.0;  // cosine of the largest angle between it and a neighbour
        for (const std::int64_t node : facet.corner)
            for (const Facet* other : about[node])
                if (const double c = dot(facet.normal, other->normal); c > smooth) turned = std::min(turned, c);
        for (const std::int64_t node : facet.corner)
            height[node] = std::max(height[node], arc * facet.edge * std::acos(turned));
    }
    return height;
}

}  // namespace

std::vector<double> pair_distances(const Mesh& mesh, const InterfaceGeometry& interface) {
    const auto dim = index(mesh.dimension());
    std::vector<double> distances(interface.node_a.size(), 0.0);
    for (std::size_t p = 0; p < distances.size(); ++p)
        for (std::size_t k = 0; k < dim; ++k)
            distances[p] += interface.frame[p * dim * dim + k] *
                            (mesh.node(interface.node_b[p])[k] - mesh.node(interface.node_a[p])[k]);
    return distances;
}

std::vector<double> face_gaps(const Mesh& mesh, const InterfaceGeometry& interface) {
    std::map<std::int64_t, double> arcs = arcs_of(mesh, interface.body_b);
    arcs.merge(arcs_of(mesh, interface.body_a));
    const auto arc_at = [&](std::int64_t node) {
        const auto found = arcs.find(node);
        return found == arcs.end() ? 0.0 : found->second;
    };
    // The map has, by tied node, the largest arc at the nodes to which it is tied. Where it stands for a mid-side node,
    // it counts with the sum of the coefficients.
    std::map<std::int64_t, double> tied;
    for (const NodeTie& tie : mesh.ties()) {
        double highest = 0.0, size = 0.0;
        for (const auto& [node, weight] : tie.of) {
            highest = std::max(highest, arc_at(node));
            size += std::abs(weight);
        }
        tied[tie.node] = mesh.node_origin(tie.node) == tie.node ? highest : size * highest;
    }
    const double least = seven_digits * mesh.size();
    std::vector<double> gaps = pair_distances(mesh, interface);
    for (std::size_t p = 0; p < gaps.size(); ++p) {
        double unknown = 0.0;
        for (const std::int64_t node : {interface.node_b[p], interface.node_a[p]}) {
            const auto found = tied.find(node);
            unknown += found == tied.end() ? arc_at(node) : found->second;
        }
        if (std::abs(gaps[p]) <= std::max(least, unknown)) gaps[p] = 0.0;
    }
    return gaps;
}

}  // namespace delam
