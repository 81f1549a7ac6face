// SPDX-License-Identifier: BSD-3-Clause
// The parts of read_scene(); each fills its own part of the scene and may use those read before it.
#pragma once

#include "scene/scene.hpp"
#include "scene/table/reader.hpp"
#include "text/wording.hpp"

namespace cli {

void read_materials(const Table& root, Scene& scene);
// Material axes by `angle` or `axes` of a layer.
std::optional<std::array<double, 6>> read_axes(const Table& table, std::int32_t dimension);
// Reads the axes of the plies of a layer (`angles`), from the bottom up; empty without this key. divisions: cells of
// the layer.
std::vector<std::array<double, 6>> read_plies(const Table& table, std::int32_t dimension, std::int64_t divisions);
// [mesh], [[bodies]] and the [[interfaces]] of a mesh. The mesh's hash becomes part of that of the scene's content.
void read_mesh_table(const Table& root, Scene& scene);
void read_bodies(const Table& root, Scene& scene);
void read_mesh_interfaces(const Table& root, Scene& scene);
// The name of a set of the mesh, which must exist.
std::string set_name(const Table& table, std::string_view key, const Scene& scene);
std::string read_formulation(const Table& table);
// Reads the law of an interface, and the direction of its first tangent.
void read_law_of(const Table& table, InterfaceData& interface, const Scene& scene);
void read_laws(const Table& root, Scene& scene);
void read_patterns(const Table& root, Scene& scene);
void read_supports_and_loads(const Table& root, Scene& scene);
void read_forces(const Table& root, Scene& scene);
void read_eigenstrains(const Table& root, Scene& scene);
// [[controls]], read before anything that may name one; the periods of a [cell] have their own control nodes.
void read_controls(const Table& root, Scene& scene);
// [[equations]], [[couplings]], [[obstacles]] and [cell].
void read_constraints(const Table& root, Scene& scene);

// Reads the place of an action and its components, as supports, loads, forces and constraints have them
// (scene_loads.cpp). places: which of point, box, patch, set, body (alone) and control are allowed; those that a scene
// of layers does not have are skipped.
using Places = std::vector<std::string>;
extern const Places any_place;
Selection read_selection(const Table& table, const Scene& scene, const Places& places = any_place);
std::vector<std::vector<double>> read_directions(const Table& table, std::string_view key, const Geometry& geometry);
std::vector<Term> read_terms(const Table& table, const Scene& scene);

// Index of the named entry (anything with .name), or an error at `key` that suggests similar names. what: "layer",
// "law", ...
template <class Entry>
std::size_t find_named(const Table& table, std::string_view key, const std::string& name,
                       const std::vector<Entry>& entries, const std::string& what) {
    for (std::size_t i = 0; i < entries.size(); ++i)
        if (entries[i].name == name) return i;
    std::vector<std::string> known;
    for (const Entry& entry : entries) known.push_back(entry.name);
    table.fail(key, "\"" + name + "\": no such " + what + suggestion(name, known) +
                        (known.empty() ? "; none is defined" : "; defined: " + listing(known)));
}

template <class Entry>
std::string new_name(const Table& table, const std::vector<Entry>& entries, const std::string& what) {
    std::string name = table.text("name");
    if (name.empty() || name.find('/') != std::string::npos || name.find('"') != std::string::npos)
        table.fail("name", "\"" + name + "\" is not allowed: at least one character, no '/' and no quotes");
    for (const Entry& entry : entries)
        if (entry.name == name) table.fail("name", "\"" + name + "\": there is another " + what + " of this name");
    return name;
}

}  // namespace cli
