// SPDX-License-Identifier: BSD-3-Clause
//
// Two bodies whose meshes do not match: each node of b's faces is paired with its projection on a's faces, a tied node
// whose displacement is that of a there, sum_i N_i u_i. Weights and normals are those of b's faces, so that the
// tractions on b follow its own nodal rule; a receives them through the N_i.
#include <map>
#include <utility>

#include "base/cancel_scope.hpp"
#include "base/numbers.hpp"
#include "mesh/pairing/interfaces.hpp"
#include "mesh/pairing/unmatched_faces.hpp"
#include "mesh/points.hpp"

namespace delam {

std::int64_t add_projected_interface(Mesh& mesh, std::int32_t label_a, std::int32_t label_b, double gap) {
    const UnmatchedFaces faces(mesh, label_a, label_b, gap, LeavingFaces::refuse);
    std::map<std::int64_t, double> nearest;  // the distance of a node's projection from its faces
    std::map<std::int64_t, Tie> ties;
    for (const BoundaryFace& face : faces.on()) {
        poll_cancel("pairs", face_work);
        Point normal = area_vector(mesh, face.all());
        const double area = length(normal);
        for (double& component : normal) component /= area;
        for (const std::int64_t node : face.all()) {
            const Point x = position(mesh, node);
            const auto found = faces.ground().under(x, normal);
            if (!found) faces.refuse_partial(face, x);
            const double distance = length(x - found->point.place);
            const auto known = nearest.find(node);
            if (known != nearest.end() && known->second <= distance) continue;
            nearest[node] = distance;
            ties[node] = tie_to(faces.ground().face(found->face), found->point);
        }
    }
    return faces.append(mesh, ties);
}

}  // namespace delam
