// SPDX-License-Identifier: BSD-3-Clause
// The timed scenes: end-notched flexure in 2D and 3D, on any mesh, with point or patch supports.
//
// A scene is made in two stages, because timing starts with the mesh in memory: make_mesh() before it, declare()
// (problem, materials, law, loads, options) within it. declare() may be called repeatedly on the same mesh.
#pragma once

#include <string>
#include <vector>

#include "api.hpp"

namespace bench {

// Elements by name. Scenes without one have standard cells, as those of other programs with which they are compared.
struct Element {
    const char* name;
    int dimension;
    std::int32_t cell_type;
    const char* formulation;
    int order;  // of the displacements
};
// nullptr: no such name.
const Element* find_element(const std::string& name);
const std::vector<Element>& elements();

struct SceneData {
    std::string name;
    const Element* element = nullptr;  // nullptr: quad4 or hex8
    int dimension = 2;
    double h = 0.5e-3;         // m, edge of the elements
    double length = 0.120;     // m, along x
    double width = 0.0;        // m, along y, 3D only
    double arm = 3e-3;         // m, thickness of each of the two arms
    double notch = 0.030;      // m, from the left end
    double patch = 0.0;        // m, length over which supports and load are spread as means; 0: points (3D: lines)
    double final_load = 6e-3;  // m
    int steps = 40;
    reference::LawData law{125e9, 125e9, 100.0, 100.0, 250.0, 250.0};
    bool brittle = false;
};

inline constexpr double end_time = 2.0;
inline double step_time(const SceneData& data, int step) { return end_time * step / data.steps; }

// Scenes by name: enf-ductile-H, enf-brittle-H with H the edge in mm (enf-ductile-0.5), block-H in 3D; enf-patch-H is
// enf-ductile-H on patches of 2 mm, because with point supports the solution does not converge as the mesh is refined.
SceneData find_scene(const std::string& name);
// Meshes, in mm, of the reference of enf-patch-H and of the runs that estimate its error. Dissipation converges with
// first order in the spacing of pairs, which quadratic cells halve: the last mesh has a quarter of the spacing of the
// finest 4-node cells.
inline std::vector<double> reference_meshes(bool quick) {
    return quick ? std::vector<double>{1.0, 0.5, 0.25} : std::vector<double>{0.5, 0.25, 0.125};
}

// Options of the solver; nullptr: the default. declare() returns false if the library does not know the option or its
// value.
struct Choice {
    const char* reduction = nullptr;
    const char* minimisation = nullptr;
    double delta = 1e-5;
    const char* solution = nullptr;
    const char* backtracking = nullptr;
};

struct Stage {
    SceneData data;
    reference::Scene scene;
    std::vector<double> adhesion;  // initial, [pairs]
};

// Throws reference::Failure if the library does not know the element.
Stage make_mesh(const SceneData& data);
bool declare(Stage& stage, const Choice& choice, std::string* refusal = nullptr);

}  // namespace bench
