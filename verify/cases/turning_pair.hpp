// SPDX-License-Identifier: BSD-3-Clause
// One ductile interface between two rigidly moved blocks whose mode changes while it softens, and the exact defect that
// the ledger of PANM 15 (2010) has with frozen mixity.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "api.hpp"

namespace cases {

inline constexpr double turning_final = 1e-4;  // m, dc of the pure modes

// Opening 1.05 dc t, slip 0.75 of it times (0.4 + 0.6 t). The slip is a polygon through 200 instants.
inline double turning_opening(double t) { return 1.05 * turning_final * t; }
inline double turning_slip(double t) {
    constexpr int parts = 200;
    const auto exact = [](double s) { return 0.75 * turning_opening(s) * (0.4 + 0.6 * s); };
    const double at = std::floor(t * parts + 1e-9);
    const double share = t * parts - at;
    return (1.0 - share) * exact(at / parts) + share * exact((at + 1.0) / parts);
}

inline reference::Scene make_turning_pair(const char* rule) {
    reference::Scene scene(2, {1.0}, {1}, {1.0, 1.0}, {1, 1}, DELAM_QUAD4);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, 1e9, 0.2);
    scene.law(0, {125e9, 125e9, 100.0, 100.0, 250.0, 250.0});
    std::vector<double> times, opening, slip;
    for (int i = 0; i <= 200; ++i) {
        times.push_back(i / 200.0);
        opening.push_back(turning_opening(times.back()));
        slip.push_back(turning_slip(times.back()));
    }
    const auto open = scene.pattern("open", times, opening), slide = scene.pattern("slide", times, slip);
    const auto below = scene.find(0, {0.0, 0.0}, {1.0, 2.0}), above = scene.find(1, {0.0, 0.0}, {1.0, 2.0});
    scene.hold(below, {1.0, 0.0});
    scene.hold(below, {0.0, 1.0});
    scene.drive(above, {0.0, 1.0}, open, std::vector<double>(above.size(), 1.0));
    scene.drive(above, {1.0, 0.0}, slide, std::vector<double>(above.size(), 1.0));
    scene.text("mixity_rule", rule);
    return scene;
}

struct TurningDefect {
    double recorded, slides, work;
};

inline TurningDefect turning_defect(const char* rule, int steps) {
    const reference::Scene scene = make_turning_pair(rule);
    reference::Solver solver(scene, 0.0);
    for (int k = 1; k <= steps; ++k) {
        solver.step(static_cast<double>(k) / steps);
        solver.commit();
    }
    const TurningDefect d{solver.value("defect"), solver.value("defect_slides"), solver.value("work")};
    std::printf("turning pair, %s, %d steps: defect %.4f, PANM 15 %.4f J/m2 of %.1f\n", rule, steps, d.recorded,
                d.slides, d.work);
    return d;
}

// int f_B dB in the limit of small steps, by the closed forms of the law: exponents 2 and equal modes scale Go and Gc
// by s = 1/sqrt((1-B)^2 + B^2).
inline double turning_integral() {
    constexpr int n = 400000;
    const auto scale = [](double b) { return 1.0 / std::sqrt((1.0 - b) * (1.0 - b) + b * b); };
    const auto mixity = [](double t) {
        const double a = turning_opening(t), c = turning_slip(t);
        return c * c / (a * a + c * c);
    };
    double sum = 0.0, zeta = 1.0;
    for (int i = 1; i < n; ++i) {
        const double t = (i + 0.5) / n, b = mixity(t);
        const double a = turning_opening(t), c = turning_slip(t), y = 0.5 * 125e9 * (a * a + c * c);
        const double onset = 100.0 * scale(b), total = 250.0 * scale(b);
        zeta =
            std::min(zeta, y > onset ? std::max(0.0, (total * std::sqrt(onset / y) - onset) / (total - onset)) : 1.0);
        const double f = -zeta * (1.0 - zeta) * 250.0 * 150.0 / (100.0 + 150.0 * zeta);  // at s = 1
        sum += f * (scale(mixity((i + 1.0) / n)) - scale(mixity(static_cast<double>(i) / n)));
    }
    return sum;
}

}  // namespace cases
