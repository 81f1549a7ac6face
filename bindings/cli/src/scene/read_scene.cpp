// SPDX-License-Identifier: BSD-3-Clause
#include "scene/read_scene.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <locale>
#include <map>
#include <sstream>

#include <fmt/format.h>

#include "deck/abaqus/read_abaqus.hpp"
#include "delam/delam.h"
#include "file/hash.hpp"
#include "file/input_file.hpp"
#include "mesh/cell_shape.hpp"
#include "mesh/cell_size.hpp"
#include "scene/scene_parts.hpp"
#include "scene/table/scene_keys.hpp"
#include "scene/table/scene_text.hpp"
#include "scene/table/setting.hpp"

namespace cli {

namespace {

// The lengths that geometry.h must divide, including the thicknesses of layers without divisions of their own.
std::vector<double> divided_lengths(const Table& root) {
    const Table geometry = root.table("geometry");
    std::vector<double> out{geometry.number("length")};
    if (geometry.has("width")) out.push_back(geometry.number("width"));
    for (const Table& layer : root.tables("layers"))
        if (!layer.has("divisions")) out.push_back(layer.number("thickness"));
    return out;
}

// Number of cells of size h in a length, which must be a multiple of h.
std::int64_t cells_of_size(const Table& root, const Table& table, std::string_view key, double length, double h) {
    constexpr double most = 2147483648.0;  // the library's limit
    const double cells = std::round(length / h);
    if (!(cells <= most))
        table.fail(key, fmt::format("h = {} makes {:.6g} cells of {}: at most {:.0f}", h, cells, length, most));
    if (divides(h, length)) return static_cast<std::int64_t>(cells);
    const std::string better = suggested_size(divided_lengths(root), h);
    table.fail(key, fmt::format("h = {} does not divide {} evenly ({:.6g} cells); {}", h, length, length / h,
                                better.empty() ? "give divisions instead"
                                               : "h = " + better + " divides all lengths and thicknesses"));
}

void read_geometry(const Table& root, Scene& scene) {
    const Table table = root.table("geometry");
    Geometry& geometry = scene.geometry;
    geometry.place = table.place();
    const std::int64_t dimension = table.whole("dimension");
    geometry.dimension = static_cast<std::int32_t>(dimension);
    geometry.lengths.push_back(table.number("length"));
    if (dimension == 3) {
        geometry.lengths.push_back(table.number("width"));
        geometry.cell_type = shape_named(table.choice("cell", shape_names(3), "hex8")).type;
    } else {
        geometry.plane = table.text("plane");
        geometry.cell_type = shape_named(table.choice("cell", shape_names(2), "quad4")).type;
    }
    if (table.has("h")) {
        const double h = table.number("h");
        for (const double length : geometry.lengths)
            geometry.divisions.push_back(cells_of_size(root, table, "h", length, h));
    } else if (dimension == 2 && !table.is_list("divisions")) {
        geometry.divisions.push_back(table.whole("divisions"));
    } else {
        geometry.divisions = table.wholes("divisions", static_cast<std::size_t>(dimension - 1));
    }
    geometry.smallest_edge = geometry.lengths[0] / static_cast<double>(geometry.divisions[0]);
    for (std::size_t i = 0; i < geometry.lengths.size(); ++i)
        geometry.smallest_edge =
            std::min(geometry.smallest_edge, geometry.lengths[i] / static_cast<double>(geometry.divisions[i]));
}

void read_layers(const Table& root, Scene& scene) {
    const Table geometry = root.table("geometry");
    for (const Table& table : root.tables("layers")) {
        Layer layer;
        layer.name = new_name(table, scene.layers, "layer");
        layer.thickness = table.number("thickness");
        if (table.has("divisions")) {
            layer.divisions = table.whole("divisions");
        } else if (geometry.has("h")) {
            layer.divisions = cells_of_size(root, table, "thickness", layer.thickness, geometry.number("h"));
        } else {
            table.fail("divisions", "is missing: a whole number >= 1 is expected (or give geometry.h)");
        }
        layer.material = find_named(table, "material", table.text("material"), scene.materials, "material");
        layer.axes = read_axes(table, scene.geometry.dimension);
        layer.plies = read_plies(table, scene.geometry.dimension, layer.divisions);
        layer.formulation = scene.materials[layer.material].formulation;
        if (layer.formulation.empty())
            layer.formulation = shape_of(scene.geometry.cell_type).has_modes() ? "incompatible" : "standard";
        layer.place = table.place();
        scene.geometry.smallest_edge =
            std::min(scene.geometry.smallest_edge, layer.thickness / static_cast<double>(layer.divisions));
        scene.geometry.height += layer.thickness;
        scene.layers.push_back(std::move(layer));
    }
    if (scene.layers.empty()) root.fail("layers", "is missing: at least one [[layers]] is expected");
}

Region read_region(const Table& table, const Geometry& geometry, bool with_value) {
    const std::size_t axes = geometry.lengths.size();
    if (axes == 1 && table.has("lower")) table.fail("lower", "is for 3D: give from and to");
    Region region;
    region.place = table.place();
    region.adhesion = with_value ? table.number("value") : 0;
    std::vector<double> lower(axes, 0.0);
    std::vector<double> upper = geometry.lengths;
    if (table.has("lower")) {
        lower = table.numbers("lower", axes);
        upper = table.numbers("upper", axes);
    } else {
        lower[0] = table.number("from");
        upper[0] = table.number("to");
    }
    for (std::size_t i = 0; i < axes; ++i) {
        if (!(lower[i] < upper[i]))
            table.fail(table.has("to") ? "to" : "upper", fmt::format("{} is not allowed: > {}", upper[i], lower[i]));
        region.lower[i] = lower[i];
        region.upper[i] = upper[i];
    }
    return region;
}

void read_interfaces(const Table& root, Scene& scene) {
    for (const Table& table : root.tables("interfaces")) {
        InterfaceData interface;
        interface.place = table.place();
        interface.lower = find_named(table, "lower", table.text("lower"), scene.layers, "layer");
        interface.upper = find_named(table, "upper", table.text("upper"), scene.layers, "layer");
        if (interface.upper != interface.lower + 1)
            table.fail("upper",
                       fmt::format("\"{}\" does not lie directly on \"{}\" (layers are listed from the bottom up)",
                                   scene.layers[interface.upper].name, scene.layers[interface.lower].name));
        interface.name = scene.layers[interface.lower].name + "-" + scene.layers[interface.upper].name;
        for (const Table& part : table.tables("part"))
            interface.parts.push_back(read_region(part, scene.geometry, false));
        for (const InterfaceData& other : scene.interfaces)
            if (other.lower == interface.lower && other.parts.empty() && interface.parts.empty())
                table.fail("lower", "there is another interface between these layers (part gives each a part of it)");
        interface.bonded = table.flag("bonded");
        if (!interface.bonded) read_law_of(table, interface, scene);
        for (const Table& notch : table.tables("notch"))
            interface.regions.push_back(read_region(notch, scene.geometry, false));
        for (const Table& part : table.tables("adhesion"))
            interface.regions.push_back(read_region(part, scene.geometry, true));
        scene.interfaces.push_back(std::move(interface));
    }
}

void read_time(const Table& root, Scene& scene) {
    const Table table = root.table("time");
    if (table.has("instants")) {
        scene.times = table.numbers("instants");
        for (std::size_t i = 1; i < scene.times.size(); ++i)
            if (!(scene.times[i] > scene.times[i - 1]))
                table.fail("instants", fmt::format("entry {} is {}: > {} is expected (strictly increasing)", i,
                                                   scene.times[i], scene.times[i - 1]));
        return;
    }
    const double start = table.number("start");
    const double end = table.number("end");
    if (!(end > start)) table.fail("end", fmt::format("{} is not allowed: > {} (the start)", end, start));
    const std::int64_t steps = table.whole("steps");
    for (std::int64_t k = 0; k <= steps; ++k)
        scene.times.push_back(start + (end - start) * static_cast<double>(k) / static_cast<double>(steps));
    for (std::size_t i = 1; i < scene.times.size(); ++i)
        if (!(scene.times[i] > scene.times[i - 1])) table.fail("steps", "so many that instants coincide");
}

// The scene keeps the key, whichever of key and alias the file has.
void read_options(const Table& root, Scene& scene) {
    if (!root.has("solver")) return;
    const Table table = root.table("solver");
    for (std::int64_t i = 0; i < delam_option_count(); ++i) {
        const char *key = "", *alias = "", *type = "";
        delam_option_info(i, &key, &type, nullptr, nullptr, nullptr, nullptr);
        delam_option_alias(i, &alias);
        const char* name = *alias != 0 && table.has(alias) ? alias : key;
        if (!table.has(name)) continue;
        SolverOption option{key, 0.0, table.place(name)};
        if (std::string_view(type) == "text") {
            option.value = table.text(name);
        } else if (std::string_view(type) == "integer") {
            option.value = static_cast<double>(table.whole(name));
        } else {
            option.value = table.number(name);
        }
        scene.options.push_back(std::move(option));
    }
}

void read_output(const Table& root, Scene& scene) {
    const Table table = root.table_or_empty("output");
    Output& output = scene.output;
    output.place = table.place();
    output.fields = {"displacement", "stress", "zeta", "jump", "traction", "contact", "front"};
    if (table.has("fields")) output.fields = table.texts("fields");
    if (table.has("every")) output.every = table.whole("every");
    output.own_snapshots = table.has("snapshots");
    output.snapshots = table.numbers("snapshots");
    output.displacement_scale = table.number("displacement_scale");
    output.brief = table.flag("brief");
    if (table.has("columns")) output.columns = table.texts("columns");
    output.columns_place = table.place("columns");
    if (table.has("sensitivities")) output.sensitivities = table.texts("sensitivities");
    output.sensitivities_place = table.place("sensitivities");
}

void read_units(const Table& root, Scene& scene) {
    const Table table = root.table_or_empty("units");
    scene.units = {{table.text("length"), table.text("force")}, table.text("time"), root.has("units")};
}

}  // namespace

Scene read_scene(const std::string& file, const std::vector<std::string>& settings) {
    Scene scene;
    scene.file = file;
    scene.settings = settings;
    if (is_abaqus_file(file)) scene.imported = import_deck(file, std::filesystem::path(file).filename().string());
    const std::string bytes = scene.imported ? scene.imported->text : read_bytes(file, most_scene_bytes);
    const std::string source = file + (scene.imported ? ", as delam import writes it" : "");
    toml::table parsed;
    try {
        parsed = parsed_text(bytes, {source, "", 0}, source);
    } catch (const toml::parse_error& e) {
        throw SceneFailure({source, "", static_cast<int>(e.source().begin.line)},
                           "not TOML: " + std::string(e.description()));
    }
    for (const std::string& setting : settings) apply_setting(parsed, setting);
    std::ostringstream content;
    content.imbue(std::locale::classic());
    content << parsed;
    scene.content_hash = hash_text(content.str());
    scene.file_hash = hash_text(bytes);

    const Table root(parsed, {source, "", 0}, scene_table("scene"),
                     parsed.contains("mesh") ? Scenes::mesh : Scenes::layers,
                     scene.imported ? &scene.imported->origins : nullptr);
    scene.title = root.text("title", "");
    if (root.has("mesh")) {
        read_mesh_table(root, scene);
        read_materials(root, scene);
        read_bodies(root, scene);
    } else {
        read_geometry(root, scene);
        read_materials(root, scene);
        read_layers(root, scene);
    }
    read_laws(root, scene);
    if (scene.mesh)
        read_mesh_interfaces(root, scene);
    else
        read_interfaces(root, scene);
    read_time(root, scene);
    read_patterns(root, scene);
    read_controls(root, scene);
    read_supports_and_loads(root, scene);
    read_forces(root, scene);
    read_eigenstrains(root, scene);
    read_constraints(root, scene);
    read_options(root, scene);
    read_output(root, scene);
    read_units(root, scene);
    return scene;
}

}  // namespace cli
