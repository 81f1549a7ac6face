// SPDX-License-Identifier: BSD-3-Clause
// Calls on meshes with plausible or hostile arguments.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "api_world.hpp"

namespace fuzz {

inline std::int32_t add_cells(Input& in, delam_mesh* mesh, bool conforming) {
    static constexpr std::int32_t per_cell[] = {0, 3, 4, 4, 8, 6, 8, 9, 10, 20};
    const std::int32_t type =
        in.seldom() ? static_cast<std::int32_t>(in.hostile_whole()) : 1 + static_cast<std::int32_t>(in.below(9));
    const std::size_t count = few(in);
    const std::size_t nodes = count * static_cast<std::size_t>(type >= 1 && type <= 9 ? per_cell[type] : 20);
    const std::int32_t base = in.base();
    std::vector<std::int64_t> connectivity = in.indices(nodes, sizes_of(mesh).nodes, base);
    std::vector<std::int32_t> bodies(count);
    for (std::int32_t& label : bodies) label = in.small_label(4);
    const auto call = conforming ? delam_mesh_add_conforming_cells : delam_mesh_add_cells;
    return IN_ORDER(call, mesh, type, static_cast<std::int64_t>(count), maybe(in, connectivity), maybe(in, bodies),
                    base);
}

inline std::int32_t add_obstacle(Input& in, delam_mesh* mesh) {
    const MeshSizes s = sizes_of(mesh);
    const std::size_t count = few(in);
    const std::int32_t base = in.base();
    std::vector<std::int64_t> nodes = in.indices(count, s.nodes, base);
    std::vector<double> normals = in.reals(count * static_cast<std::size_t>(s.dimension));
    std::vector<double> weights = in.reals(count);
    std::int64_t index = -1;
    return IN_ORDER(delam_mesh_add_obstacle, mesh, static_cast<std::int64_t>(count), maybe(in, nodes),
                    maybe(in, normals), in.flag() ? nullptr : weights.data(), in.index(s.nodes), base,
                    in.seldom() ? nullptr : &index);
}

// Nodes without cells, or any; pairs of them.
inline std::int32_t add_host_body(Input& in, delam_mesh* mesh) {
    const MeshSizes s = sizes_of(mesh);
    const std::int32_t base = in.base();
    std::vector<std::int32_t> bodies(static_cast<std::size_t>(s.nodes));
    delam_mesh_node_bodies(mesh, s.nodes, bodies.data());
    std::vector<std::int64_t> nodes;
    for (std::int64_t n = 0; n < s.nodes && nodes.size() < 8; ++n)
        if (bodies[static_cast<std::size_t>(n)] < 0 && !in.seldom()) nodes.push_back(n + (base == 1 ? 1 : 0));
    if (in.seldom()) nodes = in.indices(few(in), s.nodes, base);
    return IN_ORDER(delam_mesh_add_host_body, mesh, in.small_label(5), static_cast<std::int64_t>(nodes.size()),
                    maybe(in, nodes), base);
}

inline std::int32_t add_pairs(Input& in, delam_mesh* mesh) {
    const MeshSizes s = sizes_of(mesh);
    const std::size_t count = few(in), faces = few(in) / 2;
    const std::int32_t base = in.base(), per_face = in.seldom() ? static_cast<std::int32_t>(in.hostile_whole() % 12)
                                                                : 2 + static_cast<std::int32_t>(in.below(7));
    const std::int32_t body_a = in.small_label(5), body_b = in.small_label(5);
    std::vector<std::int32_t> bodies(static_cast<std::size_t>(s.nodes));
    delam_mesh_node_bodies(mesh, s.nodes, bodies.data());
    std::vector<std::int64_t> nodes_a, nodes_b;
    for (std::int64_t n = 0; n < s.nodes; ++n) {
        const std::int32_t body = bodies[static_cast<std::size_t>(n)];
        const std::int64_t index = n + (base == 1 ? 1 : 0);
        if (body == body_a && nodes_a.size() < count) nodes_a.push_back(index);
        if (body == body_b && nodes_b.size() < count) nodes_b.push_back(index);
    }
    nodes_a.resize(count), nodes_b.resize(count);
    if (in.seldom()) nodes_a = in.indices(count, s.nodes, base);
    std::vector<double> normals = in.reals(3 * count), weights(count);
    for (double& w : weights) w = in.real();
    std::vector<std::int64_t> face =
        in.indices(faces * static_cast<std::size_t>(std::max(per_face, 0)), static_cast<std::int64_t>(count), base);
    std::int64_t index = -1;
    return IN_ORDER(delam_mesh_add_pairs, mesh, body_a, body_b, static_cast<std::int64_t>(count), maybe(in, nodes_a),
                    maybe(in, nodes_b), maybe(in, normals), maybe(in, weights), static_cast<std::int64_t>(faces),
                    per_face, maybe(in, face), base, in.seldom() ? nullptr : &index);
}

inline std::int32_t create_layers(Input& in, Host& host, delam_mesh** out) {
    const std::int32_t dimension = in.seldom() ? static_cast<std::int32_t>(in.hostile_whole()) : 2 + in.flag();
    std::vector<double> lengths = {in.real(), in.real()};
    // Large products would only take long, so only single numbers are hostile.
    std::vector<std::int64_t> divisions = {1 + in.below(4), 1 + in.below(2)};
    const std::int64_t layers = in.below(4);
    std::vector<double> thickness(static_cast<std::size_t>(layers));
    std::vector<std::int64_t> across(static_cast<std::size_t>(layers), 1);
    for (double& t : thickness) t = in.real();
    if (in.seldom()) {
        const std::int64_t many = in.hostile_whole();
        if (many < 1 || many > 1000000000000) divisions[0] = many;
    }
    const std::int32_t type =
        in.seldom() ? static_cast<std::int32_t>(in.hostile_whole()) : 1 + static_cast<std::int32_t>(in.below(9));
    return IN_ORDER(delam_mesh_create_layers, host.context, dimension, maybe(in, lengths), maybe(in, divisions), layers,
                    maybe(in, thickness), maybe(in, across), type, out);
}

inline std::int32_t create_mesh(Input& in, Host& host, delam_mesh** out) {
    const std::int32_t dimension = in.seldom() ? static_cast<std::int32_t>(in.hostile_whole()) : 2 + in.flag();
    const std::size_t count = static_cast<std::size_t>(in.below(32));
    std::vector<double> nodes(3 * count);
    // On a grid, so that cells made of them may be valid.
    for (std::size_t i = 0; i < nodes.size(); ++i)
        nodes[i] = in.seldom() ? in.signed_real() : static_cast<double>(in.below(4));
    return delam_mesh_create(host.context, dimension, static_cast<std::int64_t>(count), maybe(in, nodes), out);
}

inline std::int32_t find_in(Input& in, const delam_mesh* mesh, bool patch) {
    const MeshSizes s = sizes_of(mesh);
    std::vector<double> lower = in.reals(3), upper = in.reals(3), direction = in.reals(3), weights;
    if (in.flag())
        for (std::size_t d = 0; d < 3; ++d) lower[d] = -1.0, upper[d] = 2.0;
    Room<std::int64_t> nodes(in, s.nodes);
    weights.resize(nodes.entries.size());
    std::int64_t count = -1;
    const std::int32_t body = in.seldom() ? in.small_label(3) : static_cast<std::int32_t>(in.below(4)) - 1;
    if (patch)
        return IN_ORDER(delam_mesh_find_patch, mesh, body, lower.data(), upper.data(), maybe(in, direction),
                        nodes.capacity, nodes.data(), weights.data(), in.seldom() ? nullptr : &count);
    return IN_ORDER(delam_mesh_find_nodes, mesh, body, maybe(in, lower), maybe(in, upper), nodes.capacity, nodes.data(),
                    in.seldom() ? nullptr : &count);
}

}  // namespace fuzz
