// SPDX-License-Identifier: BSD-3-Clause
#include "model/build_mesh.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "delam/experimental.h"
#include "model/build_contact.hpp"
#include "model/interface_parts.hpp"
#include "model/library/call.hpp"
#include "model/library/interface_pairs.hpp"
#include "model/library/selection.hpp"
#include "text/wildcard.hpp"

namespace cli {

namespace {

// The same mesh with the control nodes after its own nodes.
delam_mesh* append_controls(Model& model, const Scene& scene) {
    const delam_context* context = model.context.get();
    const Place& place = scene.geometry.place;
    const Mesh layers = std::move(model.mesh);
    std::int64_t nodes = 0;
    std::int64_t cells = 0;
    std::int64_t entries = 0;
    call(context, delam_mesh_size(layers.get(), nullptr, &nodes, &cells, nullptr, nullptr), place);
    call(context, delam_mesh_cells(layers.get(), nullptr, nullptr, nullptr, 0, nullptr, &entries), place);
    std::vector<double> coordinates(static_cast<std::size_t>(nodes * scene.geometry.dimension));
    std::vector<std::int32_t> types(static_cast<std::size_t>(cells));
    std::vector<std::int32_t> bodies(types.size());
    std::vector<std::int64_t> offsets(types.size() + 1);
    std::vector<std::int64_t> connectivity(static_cast<std::size_t>(entries));
    call(context, delam_mesh_nodes(layers.get(), nodes * scene.geometry.dimension, coordinates.data()), place);
    call(context,
         delam_mesh_cells(layers.get(), types.data(), bodies.data(), offsets.data(), entries, connectivity.data(),
                          nullptr),
         place);
    for (const ControlData& control : scene.controls)
        coordinates.insert(coordinates.end(), control.at.begin(), control.at.end());
    delam_mesh* handle = nullptr;
    const std::int32_t status =
        delam_mesh_create(model.context.get(), scene.geometry.dimension,
                          nodes + static_cast<std::int64_t>(scene.controls.size()), coordinates.data(), &handle);
    model.mesh.reset(handle);
    call(context, status, place);
    // All layers have cells of one type.
    call(context, delam_mesh_add_cells(handle, scene.geometry.cell_type, cells, connectivity.data(), bodies.data(), 0),
         place);
    return handle;
}

// Contact alone, between the nodes on a plane and the control node that carries the plane.
void add_obstacles(Model& model, const Scene& scene) {
    const auto dimension = static_cast<std::size_t>(scene.geometry.dimension);
    for (const ObstacleData& data : scene.obstacles) {
        const Selected at = select(model.context.get(), model.mesh.get(), scene, data.where, true);
        if (at.weights.empty()) throw SceneFailure(data.place, "a patch, or a set of faces, is needed");
        // The direction points into the body, against the outward normal.
        std::vector<std::int64_t> nodes;
        std::vector<double> normals;
        const auto* patch = std::get_if<Patch>(&data.where.shape);
        for (std::size_t i = 0; i < at.nodes.size(); ++i) {
            nodes.push_back(at.nodes[i]);
            for (std::size_t a = 0; a < dimension; ++a)
                normals.push_back(patch != nullptr ? -patch->normal[a] : -at.normals[i * dimension + a]);
        }
        std::int64_t index = 0;
        call(model.context.get(),
             delam_mesh_add_obstacle(
                 model.mesh.get(), static_cast<std::int64_t>(nodes.size()), nodes.data(), normals.data(), nullptr,
                 control_node(model.context.get(), model.mesh.get(), scene, data.control, data.place), 0, &index),
             data.place);
        std::int32_t body = 0;
        call(model.context.get(),
             delam_mesh_interface_size(model.mesh.get(), index, nullptr, &body, nullptr, nullptr, nullptr), data.place);
        InterfaceData interface;
        interface.lower = interface.upper = static_cast<std::size_t>(body);
        interface.name = data.name;
        interface.contact = true;
        interface.place = data.place;
        model.interfaces.push_back(std::move(interface));
    }
}

// Returns the entries that are like entry i, if it is the first of them; otherwise none.
InterfaceEntries entries_from(const Scene& scene, std::size_t i,
                              const std::function<bool(const InterfaceData&)>& alike) {
    InterfaceEntries entries;
    for (std::size_t k = 0; k < scene.interfaces.size(); ++k) {
        if (!alike(scene.interfaces[k])) continue;
        if (k < i) return {};
        entries.push_back(&scene.interfaces[k]);
    }
    return entries;
}

// Adds the last interface of the mesh to the model, in the parts of its entries.
void add_parts(Model& model, const Scene& scene, const InterfaceEntries& entries, std::size_t a, std::size_t b) {
    InterfaceParts parts(model, scene, entries, a, b);
    require_pairs(entries, parts.with_pairs());
    parts.split(model, scene);
}

void build_layers(Model& model, const Scene& scene) {
    std::vector<double> thickness;
    std::vector<std::int64_t> divisions;
    for (const Layer& layer : scene.layers) {
        thickness.push_back(layer.thickness);
        divisions.push_back(layer.divisions);
    }
    const Geometry& geometry = scene.geometry;
    delam_mesh* handle = nullptr;
    const std::int32_t status = delam_mesh_create_layers(
        model.context.get(), geometry.dimension, geometry.lengths.data(), geometry.divisions.data(),
        static_cast<std::int64_t>(thickness.size()), thickness.data(), divisions.data(), geometry.cell_type, &handle);
    model.mesh.reset(handle);
    call(model.context.get(), status, geometry.place);
    if (!scene.controls.empty()) handle = append_controls(model, scene);
    for (std::size_t i = 0; i < scene.interfaces.size(); ++i) {
        const InterfaceData& data = scene.interfaces[i];
        const auto between_these = [&](const InterfaceData& other) { return other.lower == data.lower; };
        const InterfaceEntries entries = entries_from(scene, i, between_these);
        if (entries.empty()) continue;
        std::int64_t index = 0;
        call(model.context.get(),
             delam_mesh_add_interface(handle, static_cast<std::int32_t>(data.lower),
                                      static_cast<std::int32_t>(data.upper), 0.0, &index),
             data.place);
        add_parts(model, scene, entries, data.lower, data.upper);
    }
}

// Splits off the pairs of the last interface whose two nodes are one in the file, and bonds them.
void bond_shared(Model& model, const Scene& scene, std::int64_t index) {
    InterfaceData data = model.interfaces.back();
    const delam_context* context = model.context.get();
    const delam_mesh* mesh = model.mesh.get();
    std::int64_t pairs = 0, nodes = 0;
    call(context, delam_mesh_interface_size(mesh, index, nullptr, nullptr, &pairs, nullptr, nullptr), data.place);
    call(context, delam_mesh_size(mesh, nullptr, &nodes, nullptr, nullptr, nullptr), data.place);
    std::vector<std::int64_t> node_a(static_cast<std::size_t>(pairs)), node_b(node_a.size()), shared;
    std::vector<std::int64_t> origins(static_cast<std::size_t>(nodes));
    call(context, delam_mesh_interface_pairs(mesh, index, node_a.data(), node_b.data(), nullptr, nullptr), data.place);
    call(context, delam_mesh_node_origins(mesh, nodes, origins.data()), data.place);
    for (std::size_t p = 0; p < node_a.size(); ++p)
        if (origins[static_cast<std::size_t>(node_a[p])] == origins[static_cast<std::size_t>(node_b[p])])
            shared.push_back(static_cast<std::int64_t>(p));
    if (shared.empty() || shared.size() == node_a.size())
        throw SceneFailure(data.place,
                           fmt::format("shared = \"bonded\": {} of the {} pairs of nodes are one node in the "
                                       "file; a part of them is expected",
                                       shared.size(), node_a.size()));
    std::int64_t made = 0;
    call(context,
         delam_experimental_mesh_split_interface(model.mesh.get(), index, static_cast<std::int64_t>(shared.size()),
                                                 shared.data(), 0, &made),
         data.place);
    data.bonded = true;
    data.contact = false;
    data.regions.clear();
    const auto [a, b] = std::pair(data.lower, data.upper);
    push_interface(model, scene, std::move(data), a, b);
    model.interfaces.back().name += "-shared";
}

// Interfaces between two bodies given by name.
void add_named_interfaces(Model& model, const Scene& scene) {
    std::map<std::string, std::size_t> body_named;
    for (std::size_t i = 0; i < scene.mesh->body_names.size(); ++i) body_named.emplace(scene.mesh->body_names[i], i);
    for (std::size_t i = 0; i < scene.interfaces.size(); ++i) {
        const InterfaceData& data = scene.interfaces[i];
        if (data.a.empty() || data.within() || is_pattern(data.a + data.b)) continue;
        const InterfaceEntries entries = entries_from(scene, i, [&](const InterfaceData& other) {
            return (other.a == data.a && other.b == data.b) || (other.a == data.b && other.b == data.a);
        });
        if (entries.empty()) continue;
        const std::size_t a = body_named.at(data.a);
        const std::size_t b = body_named.at(data.b);
        std::int64_t index = 0;
        const auto label_a = static_cast<std::int32_t>(a);
        const auto label_b = static_cast<std::int32_t>(b);
        call(model.context.get(),
             data.points      ? delam_mesh_add_projected_interface(model.mesh.get(), label_a, label_b, data.gap, &index)
             : data.projected ? delam_mesh_add_mortar_interface(model.mesh.get(), label_a, label_b, data.gap, &index)
                              : delam_mesh_add_interface(model.mesh.get(), label_a, label_b, data.tolerance, &index),
             data.place);
        add_parts(model, scene, entries, a, b);
        if (data.shared_bonded) bond_shared(model, scene, index);
    }
}

// The law of two bodies in contact: the one entry whose names match, else the entry for all.
const InterfaceData* entry_for(const Scene& scene, const std::string& a, const std::string& b) {
    const InterfaceData* found = nullptr;
    for (const InterfaceData& data : scene.interfaces) {
        const bool either = (fits(data.a, a) && fits(data.b, b)) || (fits(data.a, b) && fits(data.b, a));
        if (!is_pattern(data.a + data.b) || !either) continue;
        if (found != nullptr)
            throw SceneFailure(data.place, fmt::format("fits \"{}\" and \"{}\", as {} does", a, b, found->place.path));
        found = &data;
    }
    for (const InterfaceData& data : scene.interfaces) {
        if (found != nullptr || !data.a.empty()) continue;
        found = &data;
    }
    return found;
}

// Interfaces between touching bodies that have none yet. Each needs an entry: a forgotten one would separate unnoticed.
void add_other_interfaces(Model& model, const Scene& scene) {
    std::int64_t added = 0;
    // One call finds all of them.
    const InterfaceData* first = nullptr;
    for (const InterfaceData& data : scene.interfaces) {
        if (!data.a.empty() && !is_pattern(data.a + data.b)) continue;
        if (first == nullptr) first = &data;
        if (data.tolerance != first->tolerance)
            throw SceneFailure(data.place,
                               fmt::format("tolerance is {}, that of {} {}: entries with all or with * share one",
                                           data.tolerance, first->place.path, first->tolerance));
    }
    const double tolerance = first != nullptr ? first->tolerance : 0.0;
    call(model.context.get(), delam_mesh_add_all_interfaces(model.mesh.get(), tolerance, &added), scene.geometry.place);
    std::set<const InterfaceData*> used;
    for (auto index = static_cast<std::int64_t>(model.interfaces.size()); added > 0; ++index, --added) {
        std::int32_t a = 0;
        std::int32_t b = 0;
        call(model.context.get(), delam_mesh_interface_size(model.mesh.get(), index, &a, &b, nullptr, nullptr, nullptr),
             scene.geometry.place);
        const std::string& name_a = scene.layers[static_cast<std::size_t>(a)].name;
        const std::string& name_b = scene.layers[static_cast<std::size_t>(b)].name;
        const InterfaceData* entry = entry_for(scene, name_a, name_b);
        if (entry == nullptr)
            throw SceneFailure({scene.file, "interfaces", 0},
                               fmt::format("bodies \"{}\" and \"{}\" touch, but none says how they hold together; add "
                                           "a = \"{}\", b = \"{}\", or all = true for all that are left",
                                           name_a, name_b, name_a, name_b));
        used.insert(entry);
        push_interface(model, scene, *entry, static_cast<std::size_t>(a), static_cast<std::size_t>(b));
    }
    for (const InterfaceData& data : scene.interfaces)
        if ((data.a.empty() || is_pattern(data.a + data.b)) && !used.contains(&data))
            throw SceneFailure(data.place, "there are no bodies that touch and have no interface yet" +
                                               std::string(data.a.empty() ? "" : " of these names"));
}

void build_from(Model& model, const Scene& scene) {
    const MeshData& data = *scene.mesh;
    const Place& place = scene.geometry.place;
    std::vector<double> nodes = data.nodes;
    for (const ControlData& control : scene.controls) nodes.insert(nodes.end(), control.at.begin(), control.at.end());
    delam_mesh* handle = nullptr;
    const std::int32_t status =
        delam_mesh_create(model.context.get(), data.dimension, static_cast<std::int64_t>(nodes.size()) / data.dimension,
                          nodes.data(), &handle);
    model.mesh.reset(handle);
    call(model.context.get(), status, place);
    for (const CellBlock& block : data.blocks)
        call(model.context.get(),
             delam_mesh_add_conforming_cells(handle, block.type, static_cast<std::int64_t>(block.bodies.size()),
                                             block.connectivity.data(), block.bodies.data(), 0),
             place);
    for (const CellBlock& block : data.blocks)
        model.partitions.insert(model.partitions.end(), block.partitions.begin(), block.partitions.end());
    cut_bodies(model, scene);
    add_named_interfaces(model, scene);
    add_seams(model, scene);
    if (scene.general_contact)
        add_general_contact(model, scene, [&](std::size_t a, std::size_t other) {
            return entry_for(scene, scene.layers[a].name, scene.layers[other].name) != nullptr;
        });
    add_other_interfaces(model, scene);
}

}  // namespace

void build_mesh(Model& model, const Scene& scene) {
    if (scene.mesh)
        build_from(model, scene);
    else
        build_layers(model, scene);
    add_obstacles(model, scene);
}

std::int64_t set_box(Model& model, std::int64_t index, const Region& region) {
    const std::size_t before = model.said.size();
    std::int64_t count = 0;
    call(model.context.get(),
         delam_problem_set_adhesion_box(model.problem.get(), index, region.lower.data(), region.upper.data(),
                                        region.adhesion, &count),
         region.place);
    // The library knows the number of the interface, the scene the place of the region.
    const std::string library = fmt::format("interface {}: the box ", index);
    for (std::size_t i = before; i < model.said.size(); ++i)
        if (model.said[i].rfind(library, 0) == 0)
            model.said[i] = region.place.path + " " + model.said[i].substr(library.size());
    return count;
}

namespace {

// Pairs at the edge of what adheres have their whole area, half a cell more than the faces.
void say_areas(Model& model, const Region& region, const InterfaceData& data, const std::array<double, 2>& areas) {
    constexpr double told = 1.1;  // from which ratio on: less than what a finer mesh would change anyway
    if (!(areas[1] > told * areas[0]) || !(areas[0] > 0)) return;
    model.said.push_back(fmt::format(
        "interface \"{}\": the faces of \"{}\" cover {:.4g}, the pairs that adhere {:.4g}, because pairs at an edge "
        "have half a cell beyond it, too: smaller cells there make the difference less",
        data.name, region.set, areas[0], areas[1]));
}

}  // namespace

void set_mesh_regions(Model& model, const Scene& scene, std::int64_t index, const InterfaceData& data) {
    const InterfacePairs sets(model, scene, index, data);
    for (const Region& region : data.regions) {
        std::int64_t count = 0;
        if (region.set.empty()) {
            count = set_box(model, index, region);
        } else {
            const std::vector<std::int64_t> chosen = sets.in(region);
            count = static_cast<std::int64_t>(chosen.size());
            if (region.outside) say_areas(model, region, data, sets.areas(region, chosen));
            const std::vector<double> adhesion(chosen.size(), region.adhesion);
            call(model.context.get(),
                 delam_problem_set_adhesion(model.problem.get(), index, count, chosen.data(), adhesion.data(), 0),
                 region.place);
        }
        // A region for several interfaces may lie on only some of them, and a set may hold all faces.
        if (count == 0 && !(region.outside || data.a.empty() || is_pattern(data.a + data.b)))
            throw SceneFailure(region.place,
                               "no pair of the interface is in this region (pairs at its edge are its "
                               "own only where no face of the interface leads out of it)");
    }
}

}  // namespace cli
