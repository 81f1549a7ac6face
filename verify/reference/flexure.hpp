// SPDX-License-Identifier: BSD-3-Clause
// Flexure specimens of Zeman, Kruzik, Gruber (PANM 15, 2010), "Examples": two arms one above the other, notched at the
// left, supported at both ends and pressed down at mid-span. End-notched (ENF): the lower arm is supported at the
// notched end. Mixed-mode (MMF): the upper arm is supported there, at its corner on the interface, and the lower arm is
// free.
#pragma once

#include <string>
#include <vector>

#include "api.hpp"

namespace reference {

// Lengths in m, stiffness in N/m3, toughness in J/m2.
inline constexpr LawData ductile_law{125e9, 125e9, 100.0, 100.0, 250.0, 250.0};
inline constexpr LawData brittle_law{125e15, 125e15, 0.01, 0.01, 25.0, 25.0};

struct Flexure {
    bool mixed = false;  // MMF
    LawData law = ductile_law;
    double h = 1e-3;                    // edge of the square cells
    std::string element = "quad4";      // quad4, quad4-incompatible, quad8
    double patch = 0.0;                 // length over which supports and load are spread as means; 0: points
    double length = 0.120, arm = 3e-3;  // thickness of each arm
    double notch = 0.030;               // from the left end; the pair at its tip is bonded
    double final_load = 6e-3;           // at end_time; grows linearly
    double end_time = 2.0;

    double load(double time) const { return final_load * time / end_time; }
    double time(double load) const { return end_time * load / final_load; }
};

// "enf-ductile", "enf-brittle", "mmf-ductile", "mmf-brittle"; throws Failure for other names.
Flexure find_flexure(const std::string& name);

struct FlexureScene {
    Flexure data;
    Scene scene;
    std::vector<double> position;  // [pairs] distance from the left end
    std::vector<double> weight;    // [pairs]
    std::vector<double> adhesion;  // [pairs] initial: 0 in the notch
};
// Options keep their defaults: set them on the scene before making a solver.
FlexureScene make_flexure(const Flexure& data);

}  // namespace reference
