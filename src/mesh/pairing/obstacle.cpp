// SPDX-License-Identifier: BSD-3-Clause
//
// An obstacle is rigid and only translates, with its control node: each node that may touch it forms a pair with this
// node.
#include <algorithm>
#include <map>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "delam/delam.h"
#include "mesh/faces.hpp"
#include "mesh/mesh.hpp"
#include "mesh/pairing/assemble_interface.hpp"
#include "mesh/pairing/interfaces.hpp"
#include "mesh/points.hpp"

namespace delam {

std::int64_t add_obstacle(Mesh& mesh, std::span<const std::int64_t> nodes, std::span<const double> normals,
                          std::span<const double> weights, std::int64_t control) {
    const auto dim = index(mesh.dimension());
    if (nodes.empty()) fail(DELAM_ERROR_ARGUMENT, "nodes: an obstacle needs at least one");
    if (normals.size() != nodes.size() * dim || (!weights.empty() && weights.size() != nodes.size()))
        fail(DELAM_ERROR_ARGUMENT, normals.size(), " components of normals and ", weights.size(), " weights for ",
             nodes.size(), " nodes");
    if (control < 0 || control >= mesh.node_count())
        fail(DELAM_ERROR_ARGUMENT, "control_node ", control, ": must be in 0..", mesh.node_count() - 1);
    if (mesh.node_body(control) >= 0)
        fail(DELAM_ERROR_MESH, "control_node ", control, " belongs to body ", mesh.body_label(mesh.node_body(control)),
             ": an obstacle needs a node of no body");
    if (std::any_of(mesh.ties().begin(), mesh.ties().end(), [&](const NodeTie& t) { return t.node == control; }))
        fail(DELAM_ERROR_MESH, "control_node ", control, " is tied to the faces of an interface");

    InterfaceGeometry made;
    std::map<std::int64_t, std::size_t> listed;
    for (std::size_t p = 0; p < nodes.size(); ++p) {
        poll_cancel("pairs");
        const std::int64_t node = nodes[p];
        if (node < 0 || node >= mesh.node_count())
            fail(DELAM_ERROR_ARGUMENT, "nodes[", p, "] = ", node, ": must be in 0..", mesh.node_count() - 1);
        const std::int32_t body = mesh.node_body(node);
        if (body < 0) fail(DELAM_ERROR_ARGUMENT, "nodes[", p, "] = ", node, " belongs to no body");
        if (p == 0) made.body_b = body;
        if (body != made.body_b)
            fail(DELAM_ERROR_ARGUMENT, "nodes[", p, "] = ", node, " belongs to body ", mesh.body_label(body),
                 ", nodes[0] to ", mesh.body_label(made.body_b), ": each body needs an obstacle of its own");
        if (!listed.emplace(node, p).second) fail(DELAM_ERROR_ARGUMENT, "nodes[", p, "] = ", node, " occurs twice");
        const Point normal = require_normal(mesh.dimension(), normals, p);
        if (!weights.empty()) require_weight(weights, p);
        made.node_a.push_back(control);
        made.node_b.push_back(node);
        made.frame.resize(made.frame.size() + dim * dim);
        write_frame(mesh.dimension(), normal, &made.frame[p * dim * dim]);
    }

    std::vector<BoundaryFace> covered;
    for (const BoundaryFace& face : boundary_faces(mesh, made.body_b)) {
        const Point outward = area_vector(mesh, face.all());
        if (std::all_of(face.all().begin(), face.all().end(), [&](std::int64_t node) {
                const auto found = listed.find(node);
                if (found == listed.end()) return false;
                Point normal{};
                std::copy_n(&made.frame[found->second * dim * dim], dim, normal.begin());
                return dot(outward, normal) < 0.0;
            }))
            covered.push_back(turned(face));
    }
    lay_faces(mesh, covered, FaceSide::b, made);
    if (!weights.empty()) {
        made.weight.assign(weights.begin(), weights.end());
    } else {
        for (std::size_t p = 0; p < nodes.size(); ++p)
            if (!(made.weight[p] > 0.0))
                fail(DELAM_ERROR_MESH, "node ", nodes[p], " at ", place(mesh, nodes[p]),
                     " lies on no boundary face that faces the obstacle and has all its nodes in the list: give "
                     "weights");
    }
    const std::int64_t number = mesh.append(std::move(made));
    mesh.reserve(control);
    return number;
}

}  // namespace delam
