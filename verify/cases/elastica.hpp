// SPDX-License-Identifier: BSD-3-Clause
// Inextensible arms that bend by any angle, in closed form up to integrals: clamped along x, loaded by a force P across
// x at the tip, which is free to slide along x.
//
// EI theta'' = -P cos(theta) has the integral 1/2 EI theta'^2 = P (sin(tip) - sin(theta)), tip: the slope at the end.
// An arm whose clamp advances at the energy G per length has G = P sin(tip).
#pragma once

#include <cmath>
#include <numbers>

namespace cases {

// Integrals over the arm from theta = tip - s^2, where the integrands are smooth.
struct ArmIntegrals {
    double length, deflection;  // int dtheta / sqrt(sin(tip) - sin(theta)), and the same of sin(theta)
    explicit ArmIntegrals(double tip) : length(0.0), deflection(0.0) {
        constexpr int points = 2000;
        const double end = std::sqrt(tip);
        for (int i = 0; i < points; ++i) {  // midpoints
            const double s = end * (i + 0.5) / points, theta = tip - s * s;
            const double one = 2.0 * s / std::sqrt(std::sin(tip) - std::sin(theta)) * end / points;
            length += one;
            deflection += std::sin(theta) * one;
        }
    }
};

struct Arm {
    double force, length, slope;
};

// Returns the arm whose tip is deflected by w; measure: increases with the slope at the tip, and is zero for the right
// one.
template <class Measure>
double slope_where_zero(const Measure& measure) {
    double low = 1e-6, high = 0.5 * std::numbers::pi * (1.0 - 1e-9);
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        (measure(middle) < 0.0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

inline Arm arm_of_length(double stiffness, double length, double w) {
    const double slope = slope_where_zero([&](double tip) {
        const ArmIntegrals i(tip);
        return i.deflection / i.length - w / length;
    });
    const ArmIntegrals i(slope);
    return {0.5 * stiffness * (i.length / length) * (i.length / length), length, slope};
}

inline Arm growing_arm(double stiffness, double energy, double w) {
    const auto deflection = [&](double tip) {
        return ArmIntegrals(tip).deflection * std::sqrt(0.5 * stiffness * std::sin(tip) / energy);
    };
    const double slope = slope_where_zero([&](double tip) { return deflection(tip) - w; });
    const double force = energy / std::sin(slope);
    return {force, ArmIntegrals(slope).length * std::sqrt(0.5 * stiffness / force), slope};
}

}  // namespace cases
