// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies that the library knows by their nodes alone, and interfaces whose pairs the host gives, like those of an
// obstacle but with two deformable sides; and pairs of an interface that the host moves into another.
#include <algorithm>
#include <set>
#include <utility>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "mesh/faces.hpp"
#include "mesh/mesh.hpp"
#include "mesh/pairing/assemble_interface.hpp"
#include "mesh/pairing/interfaces.hpp"
#include "mesh/points.hpp"

namespace delam {

namespace {

// Returns the part of an interface whose pairs have `part` in `part_of`.
InterfaceGeometry part_of_interface(const InterfaceGeometry& whole, int dimension,
                                    const std::vector<std::uint8_t>& part_of, std::uint8_t part) {
    InterfaceGeometry made;
    made.body_a = whole.body_a;
    made.body_b = whole.body_b;
    made.nodes_per_face = whole.nodes_per_face;
    made.reach = whole.reach;
    const auto square = index(dimension) * index(dimension);
    std::vector<std::int64_t> number(part_of.size(), -1);
    for (std::size_t p = 0; p < part_of.size(); ++p) {
        if (part_of[p] != part) continue;
        number[p] = made.pair_count();
        made.node_a.push_back(whole.node_a[p]);
        made.node_b.push_back(whole.node_b[p]);
        made.weight.push_back(whole.weight[p]);
        const auto frame = whole.frame.begin() + static_cast<std::ptrdiff_t>(p * square);
        made.frame.insert(made.frame.end(), frame, frame + static_cast<std::ptrdiff_t>(square));
    }
    const auto per_face = index(whole.nodes_per_face);
    for (std::size_t f = 0; f < whole.face.size(); f += per_face) {
        const auto first = whole.face.begin() + static_cast<std::ptrdiff_t>(f);
        const auto last = first + static_cast<std::ptrdiff_t>(per_face);
        if (std::any_of(first, last, [&](std::int64_t p) { return part_of[index(p)] != part; })) continue;
        std::for_each(first, last, [&](std::int64_t p) { made.face.push_back(number[index(p)]); });
    }
    return made;
}

}  // namespace

std::int64_t add_pairs(Mesh& mesh, std::int32_t label_a, std::int32_t label_b, std::span<const std::int64_t> nodes_a,
                       std::span<const std::int64_t> nodes_b, std::span<const double> normals,
                       std::span<const double> weights, int nodes_per_face, std::span<const std::int64_t> face) {
    const auto dim = index(mesh.dimension());
    const auto [a, b] = require_unjoined(mesh, label_a, label_b);
    InterfaceGeometry made;
    made.body_a = a;
    made.body_b = b;
    if (nodes_a.empty()) fail(DELAM_ERROR_ARGUMENT, "count = 0: an interface needs at least one pair");
    const auto take = [&](std::span<const std::int64_t> nodes, std::int32_t body, const char* name) {
        std::set<std::int64_t> listed;
        for (std::size_t p = 0; p < nodes.size(); ++p) {
            poll_cancel("pairs");
            const std::int64_t node = nodes[p];
            if (node < 0 || node >= mesh.node_count())
                fail(DELAM_ERROR_ARGUMENT, name, "[", p, "] = ", node, ": must be in 0..", mesh.node_count() - 1);
            if (mesh.node_body(node) != body)
                fail(DELAM_ERROR_ARGUMENT, name, "[", p, "] = ", node, " does not belong to body ",
                     mesh.body_label(body));
            if (!listed.insert(node).second) fail(DELAM_ERROR_ARGUMENT, name, "[", p, "] = ", node, " occurs twice");
        }
    };
    take(nodes_a, a, "nodes_a");
    take(nodes_b, b, "nodes_b");
    for (std::size_t p = 0; p < nodes_a.size(); ++p) {
        const Point normal = require_normal(mesh.dimension(), normals, p);
        require_weight(weights, p);
        made.frame.resize(made.frame.size() + dim * dim);
        write_frame(mesh.dimension(), normal, &made.frame[p * dim * dim]);
    }
    made.node_a.assign(nodes_a.begin(), nodes_a.end());
    made.node_b.assign(nodes_b.begin(), nodes_b.end());
    made.weight.assign(weights.begin(), weights.end());

    made.nodes_per_face = mesh.dimension();
    if (!face.empty()) {
        const FaceRow& kind = face_row(mesh.dimension(), index(nodes_per_face));
        made.nodes_per_face = nodes_per_face;
        const auto per_face = index(nodes_per_face);
        for (std::size_t i = 0; i < face.size(); ++i) {
            if (face[i] < 0 || face[i] >= made.pair_count())
                fail(DELAM_ERROR_ARGUMENT, "faces[", i / per_face, "][", i % per_face, "] = ", face[i],
                     ": must be in 0..", made.pair_count() - 1);
            // Corners must differ, except the last one of a triangle among quadrilaterals.
            const std::size_t corners = index(kind.corners), k = i % per_face;
            for (std::size_t j = 0; j < k && k < corners; ++j)
                if (face[i] == face[i - k + j] && !(corners == 4 && k == 3 && j == 2))
                    fail(DELAM_ERROR_ARGUMENT, "faces[", i / per_face, "]: pair ", face[i],
                         " occurs twice among its corners");
        }
        made.face.assign(face.begin(), face.end());
    }
    return mesh.append(std::move(made));
}

std::int64_t split_interface(Mesh& mesh, std::int64_t interface, std::span<const std::int64_t> pairs) {
    const auto count = static_cast<std::int64_t>(mesh.interfaces().size());
    if (interface < 0 || interface >= count)
        fail(DELAM_ERROR_ARGUMENT, "interface_index ", interface, ": must be in 0..", count - 1);
    const InterfaceGeometry& whole = mesh.interfaces()[index(interface)];
    std::vector<std::uint8_t> part(whole.node_a.size(), 0);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        if (pairs[i] < 0 || pairs[i] >= whole.pair_count())
            fail(DELAM_ERROR_ARGUMENT, "pairs[", i, "] = ", pairs[i], ": must be in 0..", whole.pair_count() - 1);
        if (std::exchange(part[index(pairs[i])], std::uint8_t{1}) != 0)
            fail(DELAM_ERROR_ARGUMENT, "pairs[", i, "] = ", pairs[i], " occurs twice");
    }
    if (pairs.empty() || pairs.size() == part.size())
        fail(DELAM_ERROR_ARGUMENT, "pairs: ", pairs.size(), " of the ", part.size(), " pairs of interface ", interface,
             " are listed: each part needs at least one");
    InterfaceGeometry rest = part_of_interface(whole, mesh.dimension(), part, 0);
    const std::int64_t made = mesh.append(part_of_interface(whole, mesh.dimension(), part, 1));
    mesh.interfaces_[index(interface)] = std::move(rest);
    return made;
}

}  // namespace delam
