// SPDX-License-Identifier: BSD-3-Clause
// [mesh], its [[bodies]] and their [[interfaces]].
#include <algorithm>
#include <filesystem>
#include <unordered_map>

#include <fmt/format.h>

#include "file/hash.hpp"
#include "mesh/body_pieces.hpp"
#include "mesh/cell_shape.hpp"
#include "mesh/mesh_file.hpp"
#include "scene/read_mesh.hpp"
#include "scene/scene_generators.hpp"
#include "scene/scene_parts.hpp"
#include "text/wildcard.hpp"
#include "text/wording.hpp"

namespace cli {

namespace {

// Bodies of the mesh by their names.
using BodyIndex = std::unordered_map<std::string, std::size_t>;
BodyIndex index_of(const std::vector<std::string>& names) {
    BodyIndex out;
    for (std::size_t i = 0; i < names.size(); ++i) out.emplace(names[i], i);
    return out;
}

void require_body(const Table& table, std::string_view key, const std::string& name, const Scene& scene,
                  const BodyIndex& index) {
    const auto& names = scene.mesh->body_names;
    if (index.contains(name)) return;
    if (std::none_of(names.begin(), names.end(), [&](const std::string& n) { return fits(name, n); }))
        table.fail(key,
                   fmt::format("\"{}\": no body of the mesh {}{}; it has: {}", name,
                               is_pattern(name) ? "fits" : "has this name", suggestion(name, names), listing(names)));
}

Region read_region(const Table& table, const Scene& scene, bool with_value) {
    Region region;
    region.place = table.place();
    region.adhesion = with_value ? table.number("value") : 0;
    if (table.has("set")) {
        region.set = set_name(table, "set", scene);
        region.outside = table.flag("outside");
        return region;
    }
    const auto dimension = static_cast<std::size_t>(scene.geometry.dimension);
    const std::vector<double> lower = table.numbers("lower", dimension);
    const std::vector<double> upper = table.numbers("upper", dimension);
    for (std::size_t a = 0; a < dimension; ++a) {
        if (upper[a] < lower[a])
            table.fail("upper", fmt::format("entry {} is {}: >= {} is expected", a, upper[a], lower[a]));
        region.lower[a] = lower[a];
        region.upper[a] = upper[a];
    }
    return region;
}

MeshFile mesh_of_file(const Table& table, const Scene& scene) {
    const std::string name = table.text("file");
    if (name.empty()) table.fail("file", "is empty: the name of a mesh is expected, relative to the scene file");
    const std::string path = (std::filesystem::path(scene.file).parent_path() / name).string();
    return read_mesh(path, table.has("bodies") ? table.texts("bodies") : std::vector<std::string>{},
                     table.place("file"));
}

// True, by label, for bodies that have cells with incompatible modes.
std::vector<bool> bodies_with_modes(const MeshData& mesh) {
    std::vector<bool> found(mesh.body_names.size(), false);
    for (const CellBlock& block : mesh.blocks)
        if (shape_of(block.type).has_modes())
            for (const std::int32_t body : block.bodies) found[static_cast<std::size_t>(body)] = true;
    return found;
}

}  // namespace

std::string set_name(const Table& table, std::string_view key, const Scene& scene) {
    if (!scene.mesh) table.fail(key, "is for a scene with [mesh]");
    const std::string name = table.text(key);
    if (scene.mesh->node_sets.contains(name) || scene.mesh->face_sets.contains(name)) return name;
    std::vector<std::string> known;
    for (const auto& [set, nodes] : scene.mesh->node_sets) known.push_back(set);
    for (const auto& [set, faces] : scene.mesh->face_sets)
        if (!scene.mesh->node_sets.contains(set)) known.push_back(set);
    table.fail(key, fmt::format("\"{}\": no such set in the mesh{}{}", name, suggestion(name, known),
                                known.empty() ? "; it has none" : "; it has: " + listing(known)));
}

void read_mesh_table(const Table& root, Scene& scene) {
    const Table table = root.table("mesh");
    MeshFile file = table.has("file") ? mesh_of_file(table, scene) : MeshFile{read_generator(table), ""};
    MeshData& mesh = file.mesh;
    if (table.flag("pieces")) (void)split_into_pieces(mesh);
    Geometry& geometry = scene.geometry;
    geometry.place = table.place();
    geometry.dimension = mesh.dimension;
    if (mesh.dimension == 2)
        geometry.plane = table.has("plane") || mesh.plane.empty() ? table.text("plane") : mesh.plane;
    else if (table.has("plane"))
        table.fail("plane", "is for plane meshes only");
    std::int64_t shortest = 0;
    geometry.smallest_edge = shortest_edge(mesh, &shortest);
    if (!(geometry.smallest_edge > 0)) {
        const std::vector<FileElement> at = file_elements(mesh, {shortest});
        if (at.empty()) table.fail("file", "a cell has an edge of no length");
        throw SceneFailure(at[0].place, fmt::format("element {} has an edge of no length", at[0].label));
    }
    // A generated mesh follows from the keys of its generator.
    if (!file.hash.empty()) scene.content_hash = hash_text(scene.content_hash + file.hash);
    scene.mesh = std::make_shared<const MeshData>(std::move(mesh));
}

void read_bodies(const Table& root, Scene& scene) {
    const std::vector<Table> tables = root.tables("bodies");
    const auto& names = scene.mesh->body_names;
    const BodyIndex index = index_of(names);
    std::vector<const Table*> chosen(names.size(), nullptr);
    // A full name has priority over one with *.
    for (const bool spelt : {true, false})
        for (const Table& table : tables) {
            const std::string name = table.text("name");
            if (is_pattern(name) == spelt) continue;
            require_body(table, "name", name, scene, index);
            const std::size_t first = spelt ? index.at(name) : 0;
            for (std::size_t i = first; i < (spelt ? first + 1 : names.size()); ++i) {
                if (!spelt && !fits(name, names[i])) continue;
                if (chosen[i] != nullptr && is_pattern(chosen[i]->text("name")) == is_pattern(name))
                    table.fail("name",
                               fmt::format("\"{}\" is described by {} already", names[i], chosen[i]->place().path));
                if (chosen[i] == nullptr) chosen[i] = &table;
            }
        }
    const std::vector<bool> bends = bodies_with_modes(*scene.mesh);
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (chosen[i] == nullptr)
            root.fail("bodies", fmt::format("there is none for \"{}\"; the mesh has: {}", names[i], listing(names)));
        const Table& table = *chosen[i];
        Layer body;
        body.name = names[i];
        body.place = table.place();
        body.material = find_named(table, "material", table.text("material"), scene.materials, "material");
        body.formulation = read_formulation(table);
        if (body.formulation.empty()) body.formulation = scene.materials[body.material].formulation;
        if (body.formulation.empty()) body.formulation = bends[i] ? "incompatible" : "standard";
        body.axes = read_axes(table, scene.geometry.dimension);
        scene.layers.push_back(std::move(body));
    }
}

// Reads whether distances of the faces count; with points on a's faces they never do.
void read_gaps(const Table& table, InterfaceData& interface) {
    const bool by_default = interface.contact && interface.projected && !interface.points;
    interface.open = table.text("initial_gap", by_default ? "open" : "closed") == "open";
    if (interface.open && interface.points) table.fail("initial_gap", "\"open\" needs projection = \"means\"");
    if (table.has("adjust") && !interface.open) table.fail("adjust", "is for initial_gap = \"open\"");
    interface.adjust = table.number("adjust", 0.0);
}

std::string read_cut(const Table& table, const InterfaceData& interface, const Scene& scene) {
    if (!interface.within()) table.fail("cut", "is for the same body as a and b");
    std::string name = set_name(table, "cut", scene);
    if (!scene.mesh->face_sets.contains(name))
        table.fail("cut", fmt::format("\"{}\" is a set of nodes; a set of faces is needed", name));
    return name;
}

void read_mesh_interfaces(const Table& root, Scene& scene) {
    const BodyIndex index = index_of(scene.mesh->body_names);
    for (const Table& table : root.tables("interfaces")) {
        InterfaceData interface;
        interface.place = table.place();
        const bool all = table.flag("all");
        if (!all) {
            interface.a = table.text("a");
            interface.b = table.text("b");
            require_body(table, "a", interface.a, scene, index);
            require_body(table, "b", interface.b, scene, index);
        }
        interface.projected = table.flag("projected");
        if (interface.projected && interface.within())
            table.fail("projected", "is for two bodies: the nodes of a seam within one body have to coincide");
        if (interface.projected) {
            if (is_pattern(interface.a) || is_pattern(interface.b)) table.fail("projected", "needs two bodies by name");
            interface.points = table.text("projection", "means") == "points";
            interface.gap = table.number("gap", 0.0);
        }
        interface.tolerance = table.number("tolerance", 0.0);
        interface.shared_bonded = table.text("shared", "law") == "bonded";
        if (interface.shared_bonded && (all || is_pattern(interface.a + interface.b)))
            table.fail("shared", "\"bonded\" needs two bodies by name");
        if (table.has("cut")) interface.cut = read_cut(table, interface, scene);
        if (table.has("part") && (all || interface.within() || is_pattern(interface.a + interface.b)))
            table.fail("part", "needs two bodies by name, or one body as a and b");
        if (table.has("part") && table.has("cut"))
            table.fail("part", "is not for cut: cut each set of faces by an entry of its own");
        for (const Table& part : table.tables("part")) interface.parts.push_back(read_region(part, scene, false));
        interface.bonded = table.flag("bonded");
        interface.contact = table.flag("contact");
        read_gaps(table, interface);
        if (table.has("law")) read_law_of(table, interface, scene);
        for (const Table& notch : table.tables("notch")) interface.regions.push_back(read_region(notch, scene, false));
        for (const Table& part : table.tables("adhesion")) interface.regions.push_back(read_region(part, scene, true));
        scene.interfaces.push_back(std::move(interface));
    }
    if (!root.has("contact")) return;
    const Table contact = root.table("contact");
    if (contact.flag("general")) scene.general_contact = GeneralContact{contact.number("gap", 0.0), contact.place()};
}

}  // namespace cli
