// SPDX-License-Identifier: BSD-3-Clause
// The end-notched flexure test of Zeman, Kruzik, Gruber (PANM 15, 2010), "Examples": two arms of 120 mm x 3 mm, notch
// of 30 mm at the left, plane strain, supported at the bottom corners, pressed down at the top of mid-span by 3 mm per
// unit time. Cells are standard, as in the paper.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "api.hpp"

namespace cases {

struct Enf {
    double h = 0.5e-3;  // m, edge of the square elements
    std::int64_t subdomains = 2;
    std::string preconditioner = "series";
    std::string gluing = "orthonormal";
    reference::LawData law{125e9, 125e9, 100.0, 100.0, 250.0, 250.0};  // ductile: N/m3, J/m2
    double linear_limit = 2000;
};

inline constexpr double enf_length = 0.120;
inline constexpr double enf_arm = 3e-3;
inline constexpr double enf_notch = 0.030;
inline constexpr double enf_end_time = 2.0;
inline constexpr double enf_final_load = 6e-3;

// Distance of each pair from the left end.
inline std::vector<double> enf_positions(const reference::Scene& scene) {
    std::vector<double> x;
    for (const auto node : scene.pairs(0).node_a) x.push_back(scene.coordinate(node, 0));
    return x;
}

inline reference::Scene make_enf(const Enf& e) {
    const auto along = static_cast<std::int64_t>(std::lround(enf_length / e.h));
    const auto through = static_cast<std::int64_t>(std::lround(enf_arm / e.h));
    reference::Scene scene(2, {enf_length}, {along}, {enf_arm, enf_arm}, {through, through}, DELAM_QUAD4);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, 75e9, 0.3);
    REQUIRE(scene, delam_problem_set_formulation, scene.problem(), -1, "standard");
    scene.law(0, e.law);

    const auto x = enf_positions(scene);
    std::vector<std::int64_t> notch;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (x[i] < enf_notch - 0.25 * e.h) notch.push_back(static_cast<std::int64_t>(i));  // the tip itself is bonded
    }
    scene.adhesion(0, notch, std::vector<double>(notch.size(), 0.0));

    const double top = 2.0 * enf_arm;
    scene.hold(scene.find(0, {0.0, 0.0}, {0.0, 0.0}), {0.0, 1.0});
    const auto right = scene.find(0, {enf_length, 0.0}, {enf_length, 0.0});
    scene.hold(right, {1.0, 0.0});
    scene.hold(right, {0.0, 1.0});
    const auto press = scene.pattern("press", {0.0, enf_end_time}, {0.0, enf_final_load});
    const auto middle = scene.find(1, {0.5 * enf_length, top}, {0.5 * enf_length, top});
    scene.drive(middle, {0.0, -1.0}, press, std::vector<double>(middle.size(), 1.0));

    scene.number("subdomains", static_cast<double>(e.subdomains));
    scene.number("linear_limit", e.linear_limit);
    scene.text("preconditioner", e.preconditioner.c_str());
    scene.text("gluing", e.gluing.c_str());
    return scene;
}

inline double enf_time(int step, int steps) { return enf_end_time * step / steps; }

// Adhesion of every step of one analysis, step 0 included.
inline std::vector<std::vector<double>> enf_analysis(const Enf& e, int steps) {
    const auto scene = make_enf(e);
    reference::Solver solver(scene, 0.0);
    std::vector<std::vector<double>> states{solver.field("adhesion")};
    for (int k = 1; k <= steps; ++k) {
        solver.step(enf_time(k, steps));
        solver.commit();
        states.push_back(solver.field("adhesion"));
    }
    return states;
}

}  // namespace cases
