// SPDX-License-Identifier: BSD-3-Clause
#include "model/build_mesh.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "delam/experimental.h"
#include "model/build_contact.hpp"
#include "model/call.hpp"
#include "model/selection.hpp"
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
    for (const InterfaceData& interface : scene.interfaces) {
        std::int64_t index = 0;
        call(model.context.get(),
             delam_mesh_add_interface(handle, static_cast<std::int32_t>(interface.lower),
                                      static_cast<std::int32_t>(interface.upper), 0.0, &index),
             interface.place);
    }
    model.interfaces = scene.interfaces;
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
    std::set<std::pair<std::size_t, std::size_t>> held;
    for (const InterfaceData& data : scene.interfaces) {
        if (data.a.empty() || data.within() || is_pattern(data.a) || is_pattern(data.b)) continue;
        const std::size_t a = body_named.at(data.a);
        const std::size_t b = body_named.at(data.b);
        if (!held.insert(std::minmax(a, b)).second)
            throw SceneFailure(data.place, "there is another interface between these bodies");
        std::int64_t index = 0;
        const auto label_a = static_cast<std::int32_t>(a);
        const auto label_b = static_cast<std::int32_t>(b);
        call(model.context.get(),
             data.points      ? delam_mesh_add_projected_interface(model.mesh.get(), label_a, label_b, data.gap, &index)
             : data.projected ? delam_mesh_add_mortar_interface(model.mesh.get(), label_a, label_b, data.gap, &index)
                              : delam_mesh_add_interface(model.mesh.get(), label_a, label_b, data.tolerance, &index),
             data.place);
        push_interface(model, scene, data, a, b);
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

// The pairs of an interface that lie in a set.
class RegionPairs {
public:
    RegionPairs(const Model& model, const Scene& scene, std::int64_t index, const InterfaceData& data)
        : dimension_(static_cast<std::size_t>(scene.geometry.dimension)),
          seam_(data.within() || data.shared_bonded),
          mesh_(*scene.mesh) {
        const Place& place = data.place;
        const delam_context* context = model.context.get();
        const delam_mesh* mesh = model.mesh.get();
        std::int64_t pairs = 0;
        std::int64_t nodes = 0;
        std::int64_t faces = 0;
        std::int32_t per_face = 0;
        call(context, delam_mesh_interface_size(mesh, index, nullptr, nullptr, &pairs, &faces, &per_face), place);
        call(context, delam_mesh_size(mesh, nullptr, &nodes, nullptr, nullptr, nullptr), place);
        node_a_.resize(static_cast<std::size_t>(pairs));
        node_b_.resize(node_a_.size());
        origins_.resize(static_cast<std::size_t>(nodes));
        faces_.resize(static_cast<std::size_t>(faces * per_face));
        per_face_ = static_cast<std::size_t>(per_face);
        weights_.resize(node_b_.size());
        call(context, delam_mesh_interface_pairs(mesh, index, node_a_.data(), node_b_.data(), weights_.data(), nullptr),
             place);
        call(context, delam_mesh_interface_faces(mesh, index, faces_.data()), place);
        call(context, delam_mesh_node_origins(mesh, nodes, origins_.data()), place);
    }

    // Returns the area of the faces in a set, and that of the pairs that are not without a face in it.
    [[nodiscard]] std::array<double, 2> areas(const Region& region, const std::vector<std::int64_t>& without) const {
        std::array<double, 2> out{};
        if (seam_) return out;
        for (const double weight : weights_) out[1] += weight;
        for (const std::int64_t pair : without) out[1] -= weights_[static_cast<std::size_t>(pair)];
        for (const std::size_t face : faces_in(region.set)) out[0] += area(face);
        return out;
    }

    // Returns the pairs of a set: those all of whose faces lie in it, or those without a face in it.
    [[nodiscard]] std::vector<std::int64_t> in(const Region& region) const {
        if (region.outside) return outside(region.set);
        const std::vector<std::int64_t>& set = mesh_.node_sets.at(region.set);
        const auto in_set = [&](std::int64_t pair) {
            return either(pair, [&](std::int64_t n) { return std::binary_search(set.begin(), set.end(), n); });
        };
        // A pair from which a face leads out is a tip.
        std::vector<bool> tip(node_b_.size(), false);
        for (std::size_t f = 0; f < faces_.size(); f += per_face_) {
            const auto begin = faces_.begin() + static_cast<std::ptrdiff_t>(f);
            const auto end = begin + static_cast<std::ptrdiff_t>(per_face_);
            if (std::all_of(begin, end, in_set)) continue;
            std::for_each(begin, end, [&](std::int64_t pair) { tip[static_cast<std::size_t>(pair)] = true; });
        }
        std::vector<std::int64_t> out;
        for (std::size_t i = 0; i < node_b_.size(); ++i)
            if (!tip[i] && in_set(static_cast<std::int64_t>(i))) out.push_back(static_cast<std::int64_t>(i));
        return out;
    }

private:
    // True if b's node of a pair fulfils something. a's node may be a point within a face; at a seam, where the
    // order of the cells says which side is b, it counts too.
    template <typename Predicate>
    [[nodiscard]] bool either(std::int64_t pair, const Predicate& holds) const {
        const auto at = static_cast<std::size_t>(pair);
        return holds(origins_[static_cast<std::size_t>(node_b_[at])]) ||
               (seam_ && holds(origins_[static_cast<std::size_t>(node_a_[at])]));
    }

    // The pairs of a seam at no face of a set. A face at the tip is none of the interface, but its pair adheres.
    [[nodiscard]] std::vector<std::int64_t> beside(const std::vector<std::array<std::int64_t, 9>>& faces) const {
        std::set<std::int64_t> nodes;
        for (const auto& face : faces) nodes.insert(face.begin(), face.end());
        std::vector<std::int64_t> out;
        for (std::int64_t pair = 0; pair < static_cast<std::int64_t>(node_b_.size()); ++pair)
            if (!either(pair, [&](std::int64_t node) { return nodes.contains(node); })) out.push_back(pair);
        return out;
    }

    // Returns the area of a face by its corners.
    [[nodiscard]] double area(std::size_t face) const {
        std::vector<std::array<double, 3>> at;
        for (std::size_t i = 0; i < corners(); ++i) {
            const std::int64_t node =
                origins_[static_cast<std::size_t>(node_b_[static_cast<std::size_t>(faces_[face + i])])];
            std::array<double, 3> x{};
            std::copy_n(mesh_.nodes.begin() + static_cast<std::ptrdiff_t>(node) * mesh_.dimension, dimension_,
                        x.begin());
            at.push_back(x);
        }
        const auto from_first = [&](std::size_t i) {
            return std::array{at[i][0] - at[0][0], at[i][1] - at[0][1], at[i][2] - at[0][2]};
        };
        if (at.size() == 2) return std::hypot(from_first(1)[0], from_first(1)[1]);
        double sum = 0;
        for (std::size_t i = 2; i < at.size(); ++i) {
            const auto u = from_first(i - 1), v = from_first(i);
            sum += std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2;
        }
        return sum;
    }

    [[nodiscard]] std::size_t corners() const { return dimension_ == 2 ? 2 : per_face_ % 3 == 0 ? 3 : 4; }

    // The pairs without a face in the set.
    [[nodiscard]] std::vector<std::int64_t> outside(const std::string& name) const {
        const auto faces = mesh_.face_sets.find(name);
        if (seam_ && faces != mesh_.face_sets.end()) return beside(faces->second);
        std::vector<bool> held(node_b_.size(), false);
        for (const std::size_t f : faces_in(name))
            for (std::size_t i = 0; i < per_face_; ++i) held[static_cast<std::size_t>(faces_[f + i])] = true;
        std::vector<std::int64_t> out;
        for (std::size_t i = 0; i < held.size(); ++i)
            if (!held[i]) out.push_back(static_cast<std::int64_t>(i));
        return out;
    }

    // Returns where the faces begin that lie in a set, which is one of faces or else one of nodes that hold all
    // corners.
    [[nodiscard]] std::vector<std::size_t> faces_in(const std::string& name) const {
        const auto key_of = [](auto begin, auto end) {
            std::set<std::int64_t> key(begin, end);  // a triangle among quadrilaterals repeats a corner
            key.erase(-1);
            return key;
        };
        std::set<std::set<std::int64_t>> known;
        const auto faces = mesh_.face_sets.find(name);
        if (faces != mesh_.face_sets.end())
            for (const auto& face : faces->second) {
                const auto all = static_cast<std::size_t>(std::find(face.begin(), face.end(), -1) - face.begin());
                const std::size_t of_it = dimension_ == 2 ? 2 : all % 3 == 0 ? 3 : 4;
                known.insert(key_of(face.begin(), face.begin() + static_cast<std::ptrdiff_t>(of_it)));
            }
        const std::vector<std::int64_t>& nodes = mesh_.node_sets.at(name);
        std::vector<std::size_t> out;
        for (std::size_t f = 0; f < faces_.size(); f += per_face_) {
            std::vector<std::int64_t> at;
            for (std::size_t i = 0; i < corners(); ++i)
                at.push_back(origins_[static_cast<std::size_t>(node_b_[static_cast<std::size_t>(faces_[f + i])])]);
            const auto among = [&](std::int64_t node) { return std::binary_search(nodes.begin(), nodes.end(), node); };
            const auto first = faces_.begin() + static_cast<std::ptrdiff_t>(f);
            const bool in_set = faces != mesh_.face_sets.end()
                                    ? known.contains(key_of(at.begin(), at.end()))
                                    : std::all_of(first, first + static_cast<std::ptrdiff_t>(corners()),
                                                  [&](std::int64_t pair) { return either(pair, among); });
            if (in_set) out.push_back(f);
        }
        return out;
    }

    std::size_t dimension_;
    bool seam_;
    const MeshData& mesh_;
    std::size_t per_face_ = 1;
    std::vector<std::int64_t> node_a_, node_b_;
    std::vector<std::int64_t> faces_;
    std::vector<std::int64_t> origins_;
    std::vector<double> weights_;
};

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
    const RegionPairs sets(model, scene, index, data);
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
