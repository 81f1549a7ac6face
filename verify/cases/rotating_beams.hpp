// SPDX-License-Identifier: BSD-3-Clause
// Beams of two layers that rotate much: double cantilevers and flexure specimens.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "condensed_scenes.hpp"
#include "support.hpp"

namespace beams {

using reference::LawData;
using reference::Scene;

// N and mm, per mm of width; Poisson's ratio is 0, so that plane strain is plane stress.
constexpr double young = 135.3e3;
inline double bending_stiffness(double e, double height) { return e * height * height * height / 12.0; }

// Equal strengths and toughnesses in both modes; with the exponent 1 the mode does not matter.
inline LawData equal_modes(double strength, double toughness) {
    constexpr double stiffness = 1e5;
    const double onset = 0.5 * strength * strength / stiffness;
    return {stiffness, stiffness, onset, onset, toughness, toughness, 1.0};
}

using Place = std::array<double, 3>;

// Two layers on each other from x = 0 to the length, notched from the left; every place and direction is turned.
struct Beam {
    double length, height, notch;
    int cells, across;
    double angle = 0.0;
    int dimension = 2;
    double width = 0.0;

    Place turned(const Place& x) const {
        const double c = std::cos(angle), s = std::sin(angle);
        return {c * x[0] - s * x[1], s * x[0] + c * x[1], x[2]};
    }
    std::vector<double> along(std::size_t axis, double sign = 1.0) const {
        Place e{};
        e[axis] = sign;
        const Place t = turned(e);
        return {t.begin(), t.begin() + dimension};
    }
    Scene mesh(int layers = 2) const {
        std::vector<cases::Block> blocks;
        for (int i = 0; i < layers; ++i)
            blocks.push_back({{0.0, i * height, 0.0}, {length, (i + 1) * height, width}, {cells, across, 1}});
        return cases::make_blocks(dimension, blocks, [this](const Place& x) { return turned(x); });
    }
    // Nodes of a body at a place before the turn, over the whole width.
    std::vector<std::int64_t> nodes(const Scene& scene, std::int32_t body, double x, double y) const {
        const Place at = turned({x, y, 0.0});
        return cases::nodes_where(scene, body, [&](const double* p) {
            return std::abs(p[0] - at[0]) < 1e-6 && std::abs(p[1] - at[1]) < 1e-6;
        });
    }
    void cut(Scene& scene) const {
        std::vector<std::int64_t> cut;
        const auto pairs = scene.pairs(0);
        const std::vector<double> first = along(0);
        for (std::size_t p = 0; p < pairs.count(); ++p)
            if (first[0] * scene.coordinate(pairs.node_b[p], 0) + first[1] * scene.coordinate(pairs.node_b[p], 1) <
                notch - 1e-6)
                cut.push_back(static_cast<std::int64_t>(p));
        scene.adhesion(0, cut, std::vector<double>(cut.size(), 0.0));
    }
};

inline void drive(Scene& scene, const std::vector<std::int64_t>& nodes, const std::vector<double>& direction,
                  std::int64_t pattern) {
    scene.drive(nodes, direction, pattern, std::vector<double>(nodes.size(), 1.0));
}

// A double cantilever beam of arms of 0.5 mm, its ends moved apart by w each.
inline Scene double_cantilever(const Beam& beam, double w, const char* kinematics = "corotational") {
    Scene scene = beam.mesh();
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, young, 0.0);
    scene.law(0, equal_modes(12.0, 0.5));
    beam.cut(scene);
    scene.text("kinematics", kinematics);
    const auto load = scene.pattern("load", {0.0, 1.0}, {0.0, w});
    const double h = beam.height;
    scene.hold(beam.nodes(scene, 0, beam.length, h), beam.along(0));
    scene.hold(beam.nodes(scene, 0, beam.length, h), beam.along(1));
    scene.hold(beam.nodes(scene, 1, beam.length, h), beam.along(0));
    drive(scene, beam.nodes(scene, 0, 0.0, 0.5 * h), beam.along(1, -1.0), load);
    drive(scene, beam.nodes(scene, 1, 0.0, 1.5 * h), beam.along(1), load);
    if (beam.dimension == 3)
        for (const std::int32_t body : {0, 1})  // no piece of it moves across the plane
            scene.hold(cases::nodes_where(scene, body, [](const double* p) { return p[2] < 1e-9; }), beam.along(2));
    return scene;
}

// Two beams on each other, notched from the left, bent by w in the middle.
inline Scene flexure(const Beam& beam, const LawData& law, double w, const char* kinematics) {
    Scene scene = beam.mesh();
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, 70e3, 0.0);
    scene.law(0, law);
    beam.cut(scene);
    scene.text("kinematics", kinematics);
    const auto load = scene.pattern("load", {0.0, 1.0}, {0.0, w});
    scene.hold(beam.nodes(scene, 0, 0.0, 1.0), {0.0, 1.0});
    scene.hold(beam.nodes(scene, 0, 100.0, 1.0), {1.0, 0.0});
    scene.hold(beam.nodes(scene, 0, 100.0, 1.0), {0.0, 1.0});
    drive(scene, beam.nodes(scene, 0, 50.0, 1.0), {0.0, -1.0}, load);
    return scene;
}

}  // namespace beams
