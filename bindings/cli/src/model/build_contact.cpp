// SPDX-License-Identifier: BSD-3-Clause
#include "model/build_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "delam/experimental.h"
#include "model/interface_parts.hpp"
#include "model/library/call.hpp"

namespace cli {

namespace {

InterfaceData contact_of(const GeneralContact& general) {
    InterfaceData data;
    data.contact = true;
    data.place = general.place;
    return data;
}

// Boxes around the nodes of each body: lower ends, then upper ends.
std::vector<std::array<double, 6>> boxes_of_bodies(const Scene& scene) {
    constexpr double far = std::numeric_limits<double>::infinity();
    const MeshData& data = *scene.mesh;
    std::vector<std::array<double, 6>> boxes(scene.layers.size(), {far, far, far, -far, -far, -far});
    const auto dimension = static_cast<std::size_t>(data.dimension);
    for (const CellBlock& block : data.blocks) {
        const std::size_t nodes = block.connectivity.size() / std::max<std::size_t>(1, block.bodies.size());
        for (std::size_t i = 0; i < block.connectivity.size(); ++i) {
            auto& box = boxes[static_cast<std::size_t>(block.bodies[i / nodes])];
            for (std::size_t k = 0; k < dimension; ++k) {
                const double x = data.nodes[static_cast<std::size_t>(block.connectivity[i]) * dimension + k];
                box[k] = std::min(box[k], x);
                box[3 + k] = std::max(box[3 + k], x);
            }
        }
    }
    return boxes;
}

// General contact of two bodies that have no interface: of faces that match, else of faces that lie upon each other or
// up to `gap` apart. Faces that overhang on one side are paired from the other.
void add_contact_of(Model& model, const Scene& scene, std::size_t a, std::size_t b) {
    const GeneralContact& general = *scene.general_contact;
    const auto label = [](std::size_t body) { return static_cast<std::int32_t>(body); };
    std::int64_t index = 0;
    const std::int32_t matched = delam_mesh_add_interface(model.mesh.get(), label(a), label(b), 0.0, &index);
    if (matched == DELAM_OK) return push_interface(model, scene, contact_of(general), a, b);
    if (matched != DELAM_ERROR_MESH) call(model.context.get(), matched, general.place);
    const auto join = [&](std::size_t under, std::size_t over) {
        return delam_mesh_add_mortar_interface(model.mesh.get(), label(under), label(over), general.gap, &index);
    };
    std::int32_t status = join(a, b);
    const std::string told = delam_context_message(model.context.get());
    if (status == DELAM_ERROR_MESH && told.find("only in part") == std::string::npos) return;  // nothing faces anything
    if (status == DELAM_ERROR_MESH) {
        std::swap(a, b);
        status = join(a, b);
    }
    call(model.context.get(), status, general.place);
    InterfaceData data = contact_of(general);
    data.projected = data.open = true;
    data.gap = general.gap;
    push_interface(model, scene, std::move(data), a, b);
}

// Returns the body of the next interface that the mesh has and the model has not.
std::size_t next_body(const Model& model, const Place& place) {
    std::int32_t body = 0;
    call(model.context.get(),
         delam_mesh_interface_size(model.mesh.get(), static_cast<std::int64_t>(model.interfaces.size()), nullptr, &body,
                                   nullptr, nullptr, nullptr),
         place);
    return static_cast<std::size_t>(body);
}

// Returns the originals of the nodes on side b of the next interface that the mesh has and the model has not.
std::vector<std::int64_t> next_nodes(const Model& model, const Place& place) {
    const delam_context* context = model.context.get();
    const delam_mesh* mesh = model.mesh.get();
    const auto index = static_cast<std::int64_t>(model.interfaces.size());
    std::int64_t pairs = 0, nodes = 0;
    call(context, delam_mesh_interface_size(mesh, index, nullptr, nullptr, &pairs, nullptr, nullptr), place);
    call(context, delam_mesh_size(mesh, nullptr, &nodes, nullptr, nullptr, nullptr), place);
    std::vector<std::int64_t> node_b(static_cast<std::size_t>(pairs)), origins(static_cast<std::size_t>(nodes));
    call(context, delam_mesh_interface_pairs(mesh, index, nullptr, node_b.data(), nullptr, nullptr), place);
    call(context, delam_mesh_node_origins(mesh, nodes, origins.data()), place);
    for (std::int64_t& node : node_b) node = origins[static_cast<std::size_t>(node)];
    return node_b;
}

// Returns the nodes of a face of a set, without what fills its row.
std::span<const std::int64_t> nodes_of(const std::array<std::int64_t, 9>& face) {
    return {face.begin(), std::find(face.begin(), face.end(), -1)};
}

// The entries of interfaces within bodies: those of cuts, and one of each body for its other seams.
class SeamEntries {
public:
    explicit SeamEntries(const Scene& scene) {
        for (const InterfaceData& data : scene.interfaces) {
            if (!data.within()) continue;
            if (first_ == nullptr) first_ = &data;
            if (data.tolerance != first_->tolerance)
                throw SceneFailure(data.place, fmt::format("tolerance is {}, that of {} {}: the seams share one",
                                                           data.tolerance, first_->place.path, first_->tolerance));
            if (data.cut.empty()) {
                others_[data.a].push_back(&data);
                continue;
            }
            std::set<std::int64_t> nodes;
            for (const auto& face : scene.mesh->face_sets.at(data.cut))
                nodes.insert(nodes_of(face).begin(), nodes_of(face).end());
            cuts_.emplace_back(&data, std::move(nodes));
        }
    }

    // Returns nullptr if no interface is within a body.
    [[nodiscard]] const InterfaceData* first() const { return first_; }

    // Returns the entries of a seam through these nodes of the file: the cut on which all of them lie, else those of
    // the body's other seams.
    [[nodiscard]] InterfaceEntries of(const std::string& body, const std::vector<std::int64_t>& seam) const {
        const InterfaceData* partly = nullptr;
        for (const auto& [data, nodes] : cuts_) {
            const auto on = std::count_if(seam.begin(), seam.end(),
                                          [&, &own = nodes](std::int64_t node) { return own.contains(node); });
            const bool whole = on == static_cast<std::ptrdiff_t>(seam.size());
            if (whole && data->a != body)
                throw SceneFailure(data->place,
                                   fmt::format("cut = \"{}\": faces of this set lie within body \"{}\", and "
                                               "a and b are \"{}\"",
                                               data->cut, body, data->a));
            if (whole) return {data};
            if (on > 0 && data->a == body) partly = data;
        }
        if (partly != nullptr)
            throw SceneFailure(partly->place, fmt::format("cut = \"{}\": its seam goes on beyond this set; one set of "
                                                          "faces is needed for the whole seam",
                                                          partly->cut));
        const auto found = others_.find(body);
        return found != others_.end() ? found->second : InterfaceEntries{};
    }

    void require_used(const InterfaceEntries& used) const {
        const auto is_used = [&](const InterfaceData* entry) {
            return std::find(used.begin(), used.end(), entry) != used.end();
        };
        for (const auto& [name, entries] : others_) {
            if (std::none_of(entries.begin(), entries.end(), is_used))
                throw SceneFailure(entries.front()->place,
                                   fmt::format("\"{}\" is a and b, and this body has no {}seam: none of its outer "
                                               "faces lie on each other with nodes of their own",
                                               name, cuts_.empty() ? "" : "other "));
            require_pairs(entries, used);
        }
    }

private:
    const InterfaceData* first_ = nullptr;
    std::map<std::string, InterfaceEntries> others_;                             // by body
    std::vector<std::pair<const InterfaceData*, std::set<std::int64_t>>> cuts_;  // with the nodes of their faces
};

// Adds as many interfaces of bodies with themselves as the mesh has got.
void push_own(Model& model, const Scene& scene, std::int64_t count, const InterfaceData& data) {
    for (; count > 0; --count) {
        const std::size_t body = next_body(model, data.place);
        push_interface(model, scene, data, body, body);
    }
}

// Seams within bodies, and walls of a body that face each other up to `gap` apart.
void add_self_contact(Model& model, const Scene& scene) {
    const GeneralContact& general = *scene.general_contact;
    std::int64_t count = 0;
    call(model.context.get(), delam_mesh_add_seams(model.mesh.get(), 0.0, &count), general.place);
    push_own(model, scene, count, contact_of(general));
    if (!(general.gap > 0)) return;
    const std::int32_t status = delam_mesh_add_self_contact(model.mesh.get(), general.gap, &count);
    if (status == DELAM_ERROR_MESH) {  // a hole that is narrower than the gap, walls that overhang on both sides
        model.said.push_back(std::string("general contact leaves the walls of single bodies without contact: ") +
                             delam_context_message(model.context.get()));
        return;
    }
    call(model.context.get(), status, general.place);
    InterfaceData data = contact_of(general);
    data.projected = data.open = true;
    data.gap = general.gap;
    push_own(model, scene, count, data);
}

// True if faces of the interface are apart, or overlap, by more than what arithmetic leaves of equal coordinates.
bool apart(const Model& model, const Scene& scene, std::int64_t index) {
    constexpr double coincide = 1e-12;  // of the extent
    const auto dimension = static_cast<std::size_t>(scene.geometry.dimension);
    const delam_context* context = model.context.get();
    const delam_mesh* mesh = model.mesh.get();
    const Place& place = model.interfaces[static_cast<std::size_t>(index)].place;
    std::int64_t nodes = 0;
    std::int64_t pairs = 0;
    call(context, delam_mesh_size(mesh, nullptr, &nodes, nullptr, nullptr, nullptr), place);
    call(context, delam_mesh_interface_size(mesh, index, nullptr, nullptr, &pairs, nullptr, nullptr), place);
    std::vector<double> at(static_cast<std::size_t>(nodes) * dimension);
    std::vector<std::int64_t> node_a(static_cast<std::size_t>(pairs));
    std::vector<std::int64_t> node_b(node_a.size());
    std::vector<double> frames(node_a.size() * dimension * dimension);
    call(context, delam_mesh_nodes(mesh, static_cast<std::int64_t>(at.size()), at.data()), place);
    call(context, delam_mesh_interface_pairs(mesh, index, node_a.data(), node_b.data(), nullptr, frames.data()), place);
    const auto [low, high] = std::minmax_element(at.begin(), at.end());
    for (std::size_t p = 0; p < node_a.size(); ++p) {
        double distance = 0;
        for (std::size_t k = 0; k < dimension; ++k)
            distance +=
                frames[p * dimension * dimension + k] * (at[static_cast<std::size_t>(node_b[p]) * dimension + k] -
                                                         at[static_cast<std::size_t>(node_a[p]) * dimension + k]);
        if (std::abs(distance) > coincide * (*high - *low)) return true;
    }
    return false;
}

}  // namespace

void cut_bodies(Model& model, const Scene& scene) {
    for (const InterfaceData& data : scene.interfaces) {
        if (data.cut.empty()) continue;
        const auto& faces = scene.mesh->face_sets.at(data.cut);
        std::size_t per_face = 0;
        for (const auto& face : faces) per_face = std::max(per_face, nodes_of(face).size());
        std::vector<std::int64_t> nodes;
        for (const auto& face : faces) {
            const std::span<const std::int64_t> own = nodes_of(face);
            nodes.insert(nodes.end(), own.begin(), own.end());
            nodes.insert(nodes.end(), per_face - own.size(), own.back());  // a triangle among quadrilaterals
        }
        std::int64_t doubled = 0;
        call(model.context.get(),
             delam_experimental_mesh_cut(model.mesh.get(), static_cast<std::int64_t>(faces.size()),
                                         static_cast<std::int32_t>(per_face), nodes.data(), 0, &doubled),
             data.place);
    }
}

void add_seams(Model& model, const Scene& scene) {
    const SeamEntries entries(scene);
    const InterfaceData* first = entries.first();
    if (first == nullptr) return;
    std::int64_t count = 0;
    call(model.context.get(), delam_mesh_add_seams(model.mesh.get(), first->tolerance, &count), first->place);
    std::vector<InterfaceParts> seams;
    std::set<std::size_t> without;
    for (; count > 0; --count) {
        const std::size_t body = next_body(model, first->place);
        const std::string& name = scene.layers[body].name;
        InterfaceEntries own = entries.of(name, next_nodes(model, first->place));
        if (own.empty() && without.insert(body).second && !scene.general_contact)
            model.said.push_back(
                fmt::format("body \"{}\" has a seam and no entry for it: its sides are in contact; a = "
                            "\"{}\", b = \"{}\" with a law makes them adhere",
                            name, name, name));
        InterfaceData contact;
        contact.contact = true;
        contact.place = first->place;
        if (own.empty())
            push_interface(model, scene, contact, body, body);
        else
            seams.emplace_back(model, scene, std::move(own), body, body);
    }
    InterfaceEntries used;
    for (InterfaceParts& seam : seams) {
        const InterfaceEntries own = seam.with_pairs();
        used.insert(used.end(), own.begin(), own.end());
        seam.split(model, scene);
    }
    entries.require_used(used);
}

void add_general_contact(Model& model, const Scene& scene,
                         const std::function<bool(std::size_t, std::size_t)>& has_entry) {
    const std::vector<std::array<double, 6>> boxes = boxes_of_bodies(scene);
    std::set<std::pair<std::size_t, std::size_t>> held;
    for (const InterfaceData& data : model.interfaces) held.insert(std::minmax(data.lower, data.upper));
    std::vector<std::size_t> order(boxes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return boxes[i][0] < boxes[j][0]; });
    double size = 0;
    for (const auto& box : boxes) size = std::max(size, box[3] - box[0]);
    const double reach = scene.general_contact->gap + 1e-6 * size;
    std::vector<std::pair<std::size_t, std::size_t>> near;
    for (std::size_t i = 0; i < order.size(); ++i)
        for (std::size_t j = i + 1; j < order.size(); ++j) {
            const auto &first = boxes[order[i]], &second = boxes[order[j]];
            if (second[0] > first[3] + reach) break;
            bool meet = true;
            for (std::size_t k = 1; k < static_cast<std::size_t>(scene.geometry.dimension); ++k)
                meet = meet && second[k] <= first[3 + k] + reach && first[k] <= second[3 + k] + reach;
            const auto bodies = std::minmax(order[i], order[j]);
            if (meet && !held.contains(bodies) && !has_entry(bodies.first, bodies.second)) near.emplace_back(bodies);
        }
    std::sort(near.begin(), near.end());
    for (const auto& [a, b] : near) add_contact_of(model, scene, a, b);
    add_self_contact(model, scene);
}

void set_gaps(Model& model, const Scene& scene) {
    std::int64_t pattern = -1;
    for (std::size_t i = 0; i < model.interfaces.size(); ++i) {
        const InterfaceData& data = model.interfaces[i];
        const auto index = static_cast<std::int64_t>(i);
        if (!data.open || !apart(model, scene, index)) continue;
        if (pattern < 0) {
            std::string name = "initial-gaps";
            const auto taken = [&](const PatternData& other) { return other.name == name; };
            while (std::any_of(scene.patterns.begin(), scene.patterns.end(), taken)) name += "-";
            const double always = 1.0;
            call(model.context.get(),
                 delam_problem_add_pattern(model.problem.get(), name.c_str(), 1, &always, &always, &pattern),
                 data.place);
        }
        call(model.context.get(), delam_problem_set_gaps(model.problem.get(), index, pattern, nullptr, data.adjust),
             data.place);
    }
}

}  // namespace cli
