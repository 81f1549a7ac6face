// SPDX-License-Identifier: BSD-3-Clause
#include "model/library/selection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "model/library/call.hpp"
#include "model/library/set_faces.hpp"

namespace cli {

namespace {

struct MeshNodes {
    std::vector<double> coordinates;
    std::vector<std::int32_t> bodies;
};

MeshNodes all_nodes(const delam_context* context, const delam_mesh* mesh, const Place& place) {
    std::int32_t dimension = 0;
    std::int64_t count = 0;
    call(context, delam_mesh_size(mesh, &dimension, &count, nullptr, nullptr, nullptr), place);
    MeshNodes out{std::vector<double>(static_cast<std::size_t>(count * dimension)),
                  std::vector<std::int32_t>(static_cast<std::size_t>(count))};
    call(context, delam_mesh_nodes(mesh, count * dimension, out.coordinates.data()), place);
    call(context, delam_mesh_node_bodies(mesh, count, out.bodies.data()), place);
    return out;
}

const char* noun(const Scene& scene) { return scene.mesh ? "body" : "layer"; }

std::string layer_name(const Scene& scene, std::int32_t body) {
    if (body < 0) return "(none)";
    return scene.layers[static_cast<std::size_t>(body)].name;
}

Selected select_point(const delam_context* context, const delam_mesh* mesh, const Scene& scene,
                      const Selection& selection, const Point& point) {
    const MeshNodes nodes = all_nodes(context, mesh, selection.place);
    const std::size_t dimension = point.at.size();
    std::vector<std::int64_t> hits;
    double nearest = std::numeric_limits<double>::infinity();
    std::size_t nearest_node = 0;
    for (std::size_t i = 0; i < nodes.bodies.size(); ++i) {
        if (nodes.bodies[i] < 0 || (selection.body >= 0 && nodes.bodies[i] != selection.body)) continue;
        double square = 0;
        for (std::size_t a = 0; a < dimension; ++a)
            square += std::pow(nodes.coordinates[i * dimension + a] - point.at[a], 2);
        const double distance = std::sqrt(square);
        if (distance < nearest) {
            nearest = distance;
            nearest_node = i;
        }
        if (distance <= selection.tolerance) hits.push_back(static_cast<std::int64_t>(i));
    }
    const Place where{selection.place.file, selection.place.path + ".point", selection.place.line};
    if (hits.empty()) {
        const auto* at = nodes.coordinates.data() + nearest_node * dimension;
        throw SceneFailure(
            where, fmt::format("{}: no node within {:.3g}; the nearest is at [{}] in {} \"{}\", {:.3g} away", point.at,
                               selection.tolerance, fmt::join(at, at + dimension, ", "), noun(scene),
                               layer_name(scene, nodes.bodies[nearest_node]), nearest));
    }
    if (hits.size() > 1) {
        std::vector<std::string> names;
        for (const std::int64_t node : hits)
            names.push_back(layer_name(scene, nodes.bodies[static_cast<std::size_t>(node)]));
        throw SceneFailure(
            where, fmt::format("{}: {} nodes are there, of {} {}; name one with {} = \"..\"", point.at, hits.size(),
                               scene.mesh ? "bodies" : "layers", fmt::join(names, ", "), noun(scene)));
    }
    const auto* at = nodes.coordinates.data() + static_cast<std::size_t>(hits.front()) * dimension;
    return {hits, {}, {at, at + dimension}, {}};
}

Selected select_box(const delam_context* context, const delam_mesh* mesh, const Selection& selection, const Box& box) {
    std::vector<double> lower = box.lower;
    std::vector<double> upper = box.upper;
    for (std::size_t a = 0; a < lower.size(); ++a) {
        lower[a] -= selection.tolerance;
        upper[a] += selection.tolerance;
    }
    Selected out;
    std::int64_t count = 0;
    call(context, delam_mesh_find_nodes(mesh, selection.body, lower.data(), upper.data(), 0, nullptr, &count),
         selection.place);
    out.nodes.resize(static_cast<std::size_t>(count));
    call(context,
         delam_mesh_find_nodes(mesh, selection.body, lower.data(), upper.data(), count, out.nodes.data(), &count),
         selection.place);
    // Control nodes and tied nodes may have the same position.
    const std::vector<std::int32_t> bodies = all_nodes(context, mesh, selection.place).bodies;
    out.nodes.erase(std::remove_if(out.nodes.begin(), out.nodes.end(),
                                   [&](std::int64_t node) { return bodies[static_cast<std::size_t>(node)] < 0; }),
                    out.nodes.end());
    if (out.nodes.empty())
        throw SceneFailure(selection.place, fmt::format("no node is in the box {} .. {}", box.lower, box.upper));
    return out;
}

// Selects from all bodies if none is named: what they have there side by side acts as one.
Selected select_patch(const delam_context* context, const delam_mesh* mesh, const Scene& scene,
                      const Selection& selection, const Patch& patch) {
    Selected out;
    const std::int32_t first = selection.body < 0 ? 0 : selection.body;
    const std::int32_t last = selection.body < 0 ? static_cast<std::int32_t>(scene.layers.size()) - 1 : selection.body;
    for (std::int32_t body = first; body <= last; ++body) {
        std::int64_t count = 0;
        const auto find = [&](std::int64_t capacity, std::int64_t* nodes, double* weights) {
            call(context,
                 delam_mesh_find_patch(mesh, body, patch.lower.data(), patch.upper.data(), patch.normal.data(),
                                       capacity, nodes, weights, &count),
                 selection.place);
        };
        find(0, nullptr, nullptr);
        if (count == 0) continue;
        const std::size_t old = out.nodes.size();
        out.nodes.resize(old + static_cast<std::size_t>(count));
        out.weights.resize(out.nodes.size());
        find(count, out.nodes.data() + old, out.weights.data() + old);
    }
    const Place where{selection.place.file, selection.place.path + ".patch", selection.place.line};
    if (out.nodes.empty()) throw SceneFailure(where, "no boundary face with this outward normal is there");
    return out;
}

// All nodes of the set, including all copies of doubled ones; only those of a body, if one is named. A tied node that
// stands for one of them is no place to hold or load anything at.
Selected select_set(const delam_context* context, const delam_mesh* mesh, const Scene& scene,
                    const Selection& selection, const std::string& name) {
    const MeshNodes nodes = all_nodes(context, mesh, selection.place);
    const auto count = static_cast<std::int64_t>(nodes.bodies.size());
    std::vector<std::int64_t> origins(nodes.bodies.size());
    call(context, delam_mesh_node_origins(mesh, count, origins.data()), selection.place);
    std::vector<bool> in(nodes.bodies.size(), name.empty());
    if (!name.empty()) {
        const auto set = scene.mesh->node_sets.find(name);
        if (set != scene.mesh->node_sets.end())
            for (const std::int64_t node : set->second) in[static_cast<std::size_t>(node)] = true;
    }
    Selected out;
    for (std::size_t i = 0; i < nodes.bodies.size(); ++i)
        if (in[static_cast<std::size_t>(origins[i])] &&
            (selection.body < 0 ? nodes.bodies[i] >= 0 || origins[i] == static_cast<std::int64_t>(i)
                                : nodes.bodies[i] == selection.body))
            out.nodes.push_back(static_cast<std::int64_t>(i));
    if (out.nodes.empty())
        throw SceneFailure(selection.place, fmt::format("no node of the set \"{}\" is in body \"{}\"", name,
                                                        layer_name(scene, selection.body)));
    return out;
}

}  // namespace

// Control nodes follow the nodes of a mesh file, before all copies; with layers they come last, before tied nodes of
// interfaces.
std::int64_t control_node(const delam_context* context, const delam_mesh* mesh, const Scene& scene, std::size_t index,
                          const Place& place) {
    if (scene.mesh)
        return static_cast<std::int64_t>(scene.mesh->nodes.size()) / scene.mesh->dimension +
               static_cast<std::int64_t>(index);
    std::int64_t count = 0, tied = 0;
    call(context, delam_mesh_size(mesh, nullptr, &count, nullptr, nullptr, nullptr), place);
    call(context, delam_mesh_node_ties(mesh, &tied, nullptr, nullptr, nullptr, nullptr, nullptr), place);
    return count - tied - static_cast<std::int64_t>(scene.controls.size()) + static_cast<std::int64_t>(index);
}

Selected select(const delam_context* context, const delam_mesh* mesh, const Scene& scene, const Selection& selection,
                bool faces) {
    if (const auto* set = std::get_if<NamedSet>(&selection.shape)) {
        if (faces) return select_faces(context, mesh, scene, selection, set->name);
        return select_set(context, mesh, scene, selection, set->name);
    }
    if (const auto* control = std::get_if<ControlNode>(&selection.shape))
        return {{control_node(context, mesh, scene, control->index, selection.place)}, {}, {}, {}};
    if (const auto* point = std::get_if<Point>(&selection.shape))
        return select_point(context, mesh, scene, selection, *point);
    if (const auto* box = std::get_if<Box>(&selection.shape)) return select_box(context, mesh, selection, *box);
    return select_patch(context, mesh, scene, selection, std::get<Patch>(selection.shape));
}

}  // namespace cli
