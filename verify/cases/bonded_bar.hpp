// SPDX-License-Identifier: BSD-3-Clause
// A bar bonded to a rigid base and pulled at its free end: one thin row of elements that can only stretch (no lateral
// motion, no lateral contraction) on a base with all nodes fixed. The bond has a Griffith law: no damage before the
// toughness is reached, complete damage after.
//
// Et is the membrane stiffness per unit width, k the tangential stiffness of the bond, and lam = sqrt(Et/k) the length
// over which the bond takes up the load. A bar that is free over a and bonded beyond (with its far end many lam away)
// has, for the end displacement w,
//     F = Et w / (a + lam),    G = F^2 / (2 Et),
// so the plateau is F = sqrt(2 G Et) and the front a = w sqrt(Et/(2G)) - lam; for a rigid bond lam = 0.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "api.hpp"

namespace cases {

struct Bar {
    std::int64_t cells = 50;    // along the bar
    double length = 1.0;        // m
    double start = 0.2;         // m, free from the loaded end on: a0
    double membrane = 1e6;      // N/m, Et
    double toughness = 50.0;    // J/m2
    double bond_length = 0.04;  // m, lam
    bool held = true;           // the far end
    double final_load = 0.0;    // m, at time 1

    double h() const { return length / static_cast<double>(cells); }
    double plateau() const { return std::sqrt(2.0 * toughness * membrane); }  // N/m
    // Load of a front on the plateau, and the front of a load.
    double load(double front) const { return (front + bond_length) * plateau() / membrane; }
    double front(double w) const { return w * membrane / plateau() - bond_length; }
};

inline reference::Scene make_bar(const Bar& bar) {
    // A hundred times thinner than a cell is long: the upper nodes follow the lower ones, and shear takes 1e-4 of the
    // energy.
    const double thickness = 0.01 * bar.h();
    reference::Scene scene(2, {bar.length}, {bar.cells}, {thickness, thickness}, {1, 1}, DELAM_QUAD4);
    scene.interface(0, 1);
    scene.begin();
    REQUIRE(scene, delam_problem_set_plane, scene.problem(), "plane-stress");
    scene.elastic(-1, bar.membrane / thickness, 0.0);
    const double k = bar.membrane / (bar.bond_length * bar.bond_length);
    scene.law(0, {k, k, bar.toughness, bar.toughness, bar.toughness, bar.toughness});
    const auto pairs = scene.pairs(0);
    std::vector<std::int64_t> free;
    for (std::size_t p = 0; p < pairs.count(); ++p)
        if (scene.coordinate(pairs.node_a[p], 0) < bar.start - 0.25 * bar.h())
            free.push_back(static_cast<std::int64_t>(p));
    scene.adhesion(0, free, std::vector<double>(free.size(), 0.0));
    const double far = bar.length;
    const auto base = scene.find(0, {0.0, 0.0}, {far, thickness});
    const auto upper = scene.find(1, {0.0, thickness}, {far, 2.0 * thickness});
    scene.hold(base, {1.0, 0.0});
    scene.hold(base, {0.0, 1.0});
    scene.hold(upper, {0.0, 1.0});
    if (bar.held) scene.hold(scene.find(1, {far, thickness}, {far, 2.0 * thickness}), {1.0, 0.0});
    const auto pull = scene.pattern("pull", {0.0, 1.0}, {0.0, bar.final_load});
    const auto end = scene.find(1, {0.0, thickness}, {0.0, 2.0 * thickness});
    scene.drive(end, {-1.0, 0.0}, pull, std::vector<double>(end.size(), 1.0));
    return scene;
}

}  // namespace cases
