// SPDX-License-Identifier: BSD-3-Clause
// [[thermal]]: a change of temperature acts through the expansions of the materials. [[eigenstrains]]: any other
// prescribed strain.
#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "scene/scene_parts.hpp"
#include "text/wildcard.hpp"

namespace cli {

namespace {

std::string key_of_places(const Scene& scene) { return scene.mesh ? "bodies" : "layers"; }

// Indices of the layers named by `layers`, or of the bodies named by `bodies`; all if neither is given.
std::vector<std::size_t> read_places(const Table& table, const Scene& scene) {
    std::vector<std::size_t> places(scene.layers.size());
    std::iota(places.begin(), places.end(), std::size_t{0});
    const std::string key = key_of_places(scene);
    if (!table.has(key)) return places;
    places.clear();
    for (const std::string& name : table.texts(key)) {
        if (!is_pattern(name)) {
            places.push_back(find_named(table, key, name, scene.layers, scene.mesh ? "body" : "layer"));
            continue;
        }
        const std::size_t before = places.size();
        for (std::size_t i = 0; i < scene.layers.size(); ++i)
            if (fits(name, scene.layers[i].name)) places.push_back(i);
        if (places.size() == before) table.fail(key, fmt::format("\"{}\": no body has such a name", name));
    }
    return places;
}

}  // namespace

void read_eigenstrains(const Table& root, Scene& scene) {
    for (const Table& table : root.tables("thermal")) {
        const std::size_t pattern = find_named(table, "pattern", table.text("pattern"), scene.patterns, "pattern");
        for (const std::size_t layer : read_places(table, scene)) {
            const Material& material = scene.materials[scene.layers[layer].material];
            if (!material.expansion)
                table.fail(
                    table.has(key_of_places(scene)) ? key_of_places(scene) : "pattern",
                    fmt::format(
                        "material \"{}\" of {} \"{}\" has no expansion (0 is allowed); or name the {} that are heated",
                        material.name, scene.mesh ? "body" : "layer", scene.layers[layer].name, key_of_places(scene)));
            const auto& along = *material.expansion;
            scene.eigenstrains.push_back(
                {static_cast<std::int32_t>(layer), {along[0], along[1], along[2], 0, 0, 0}, pattern, table.place()});
        }
    }
    for (const Table& table : root.tables("eigenstrains")) {
        const std::size_t pattern = find_named(table, "pattern", table.text("pattern"), scene.patterns, "pattern");
        const std::vector<double> given = table.numbers("strain");
        std::array<double, 6> strain{};
        std::copy(given.begin(), given.end(), strain.begin());
        if (scene.geometry.dimension == 2 &&
            (std::fpclassify(strain[4]) != FP_ZERO || std::fpclassify(strain[5]) != FP_ZERO))
            table.fail("strain",
                       fmt::format("has 2yz = {}, 2zx = {}: 0 is expected in the plane", strain[4], strain[5]));
        for (const std::size_t layer : read_places(table, scene))
            scene.eigenstrains.push_back({static_cast<std::int32_t>(layer), strain, pattern, table.place()});
    }
}

}  // namespace cli
