// SPDX-License-Identifier: BSD-3-Clause
// [[materials]]: isotropic, orthotropic, or the short form of the transversely isotropic ones.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <fmt/format.h>

#include "scene/scene_parts.hpp"

namespace cli {

namespace {

constexpr const char* constants[] = {"E1", "E2", "E3", "nu12", "nu13", "nu23", "G12", "G13", "G23"};

std::array<double, 9> read_constants(const Table& table) {
    const auto constant = [&](const char* key) { return table.number(key); };
    const bool full = table.has("E3") || table.has("nu13") || table.has("G13") || table.has("G23");
    if (full) {
        std::array<double, 9> all{};
        std::transform(std::begin(constants), std::end(constants), all.begin(), constant);
        return all;
    }
    const double e2 = constant("E2"), nu12 = constant("nu12"), nu23 = constant("nu23"), g12 = constant("G12");
    if (!(nu23 > -1.0 && nu23 < 1.0)) table.fail("nu23", fmt::format("{} is not allowed: in (-1, 1)", nu23));
    return {constant("E1"), e2, e2, nu12, nu12, nu23, g12, g12, e2 / (2.0 * (1.0 + nu23))};
}

}  // namespace

std::string read_formulation(const Table& table) { return table.text("formulation", ""); }

void read_materials(const Table& root, Scene& scene) {
    for (const Table& table : root.tables("materials")) {
        Material material;
        material.name = new_name(table, scene.materials, "material");
        if (std::any_of(std::begin(constants), std::end(constants), [&](const char* key) { return table.has(key); })) {
            material.elastic = read_constants(table);
        } else {
            const double young = table.number("young");
            material.elastic = Isotropic{young, table.number("poisson")};
        }
        material.formulation = read_formulation(table);
        if (table.has("expansion")) {
            std::vector<double> along(3, 0.0);
            if (table.is_list("expansion"))
                along = table.numbers("expansion");
            else
                along.assign(3, table.number("expansion"));
            material.expansion = std::array<double, 3>{along[0], along[1], along[2]};
        }
        material.place = table.place();
        scene.materials.push_back(std::move(material));
    }
}

namespace {

// The stack direction is y in 2D and z in 3D; angle 0 has the material's axis 1 along x. In 2D the axis then turns out
// of the plane. Degrees; multiples of 90 are exact.
std::array<double, 6> axes_at(double degrees, std::int32_t dimension) {
    const double angle = std::remainder(degrees, 360.0);
    const double quarter = std::remainder(angle, 90.0), radian = quarter * std::acos(-1.0) / 180.0;
    double c = std::cos(radian), s = std::sin(radian);
    for (auto turns = (static_cast<int>(std::lround((angle - quarter) / 90.0)) + 4) % 4; turns > 0; --turns) {
        std::swap(c, s);
        c = -c;
    }
    if (dimension == 2) return {c, 0.0, s, s, 0.0, -c};
    return {c, s, 0.0, -s, c, 0.0};
}

}  // namespace

std::optional<std::array<double, 6>> read_axes(const Table& table, std::int32_t dimension) {
    if (table.has("axes")) {
        const std::vector<std::vector<double>> rows = table.points("axes", 3);
        return std::array<double, 6>{rows[0][0], rows[0][1], rows[0][2], rows[1][0], rows[1][1], rows[1][2]};
    }
    if (!table.has("angle")) return std::nullopt;
    return axes_at(table.number("angle"), dimension);
}

std::vector<std::array<double, 6>> read_plies(const Table& table, std::int32_t dimension, std::int64_t divisions) {
    std::vector<std::array<double, 6>> plies;
    if (!table.has("angles")) return plies;
    for (const double angle : table.numbers("angles")) plies.push_back(axes_at(angle, dimension));
    const auto count = static_cast<std::int64_t>(plies.size());
    if (divisions % count != 0)
        table.fail("angles",
                   fmt::format("has {} plies, but the layer has {} cells across its thickness: each ply needs "
                               "the same number of cells",
                               count, divisions));
    return plies;
}

}  // namespace cli
