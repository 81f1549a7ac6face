// SPDX-License-Identifier: BSD-3-Clause
// Stacks of layers in three-point bending, notched at the left end: problems of any size for tests that count.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "mesh/layers.hpp"
#include "mesh/pairing/interfaces.hpp"
#include "scene/problem.hpp"

namespace unit {

struct Flexure {
    int dimension = 2;
    std::int64_t along = 60, across = 6, through = 3;  // cells of a layer
    std::size_t layers = 2;
    double length = 0.120, width = 0.012, thickness = 3e-3;  // of a layer
    double notch = 0.030;
    double press = 6e-3;   // at time 1
    bool control = false;  // a node of no body, the last
    delam::Law law = [] {
        delam::Law l;
        l.normal_stiffness = l.tangential_stiffness = 125e9;
        l.normal_onset = l.tangential_onset = 100.0;
        l.normal_toughness = l.tangential_toughness = 250.0;
        return l;
    }();
};

inline delam::Problem make_flexure(const Flexure& f) {
    using namespace delam;
    const auto axes = static_cast<std::size_t>(f.dimension - 1);
    const std::vector<double> lengths{f.length, f.width}, thickness(f.layers, f.thickness);
    const std::vector<std::int64_t> divisions{f.along, f.across}, through(f.layers, f.through);
    auto mesh = std::make_shared<Mesh>(make_layers(f.dimension, std::span(lengths).first(axes),
                                                   std::span(divisions).first(axes), thickness, through,
                                                   f.dimension == 2 ? CellType::quad4 : CellType::hex8));
    if (f.control) {
        std::vector<double> nodes(mesh->nodes().begin(), mesh->nodes().end());
        nodes.resize(nodes.size() + static_cast<std::size_t>(f.dimension), -1.0);
        auto with = std::make_shared<Mesh>(f.dimension, nodes);
        for (std::int64_t c = 0; c < mesh->cell_count(); ++c) {
            const std::int32_t label = mesh->body_label(mesh->cell_body(c));
            with->add_cells(mesh->cell_type(c), mesh->cell(c), std::span(&label, 1));
        }
        mesh = std::move(with);
    }
    for (std::size_t i = 0; i + 1 < f.layers; ++i)
        add_interface(*mesh, static_cast<std::int32_t>(i), static_cast<std::int32_t>(i + 1), 1e-6);
    Problem problem(mesh);
    problem.options.kinematics = "linear";  // deflections are as large as a test likes
    for (auto& material : problem.material) material = Elastic{75e9, 0.3};
    for (std::size_t i = 0; i < problem.interfaces.size(); ++i) {
        problem.interfaces[i].law = f.law;
        const InterfaceGeometry& face = mesh->interfaces()[i];
        for (std::size_t p = 0; p < face.node_a.size(); ++p)
            problem.interfaces[i].adhesion[p] = mesh->node(face.node_a[p])[0] < f.notch - 1e-6 ? 0.0 : 1.0;
    }
    problem.patterns.push_back({"press", {0.0, 1.0}, {0.0, f.press}, Pattern::Drives::displacement});
    const double top = static_cast<double>(f.layers) * f.thickness;
    const int up = f.dimension - 1;
    const auto near = [](double a, double b) { return std::abs(a - b) < 1e-9; };
    for (std::int64_t node = 0; node < mesh->node_count(); ++node) {
        const auto x = mesh->node(node);
        const auto hold = [&](int c, std::vector<double> prescribed) {
            problem.constraints.push_back({{f.dimension * node + c}, {1.0}, std::move(prescribed)});
        };
        if (near(x[static_cast<std::size_t>(up)], 0.0) && (near(x[0], 0.0) || near(x[0], f.length))) hold(up, {});
        if (near(x[static_cast<std::size_t>(up)], 0.0) && near(x[0], f.length))
            for (int c = 0; c < up; ++c) hold(c, {});
        if (near(x[static_cast<std::size_t>(up)], top) && near(x[0], 0.5 * f.length)) hold(up, {-1.0});
    }
    return problem;
}

}  // namespace unit
