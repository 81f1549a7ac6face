// SPDX-License-Identifier: BSD-3-Clause
// Prediction of the length of an interface's process zone, before anything is solved.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scene/problem.hpp"

namespace delam {

// The process zone of an interface. Its length at a peak traction s = sqrt(2 k Go) and a toughness Gc of a pure mode is
// l = E' Gc / s^2 in a thick body; in slender arms of thickness h < l it is l^(1/4) h^(3/4) in mode I and (l h)^(1/2)
// in mode II (Yang and Cox, Int. J. Fract. 133, 2005). The shorter mode counts, in the body where it is shorter. E':
// E/(1 - nu^2), in plane stress E, for an orthotropic body its smallest Young's modulus; h: volume of the body over
// area of the interface.
struct ProcessZone {
    double length = 0.0;   // 0: no softening law
    double spacing = 0.0;  // mean distance of its initially adhering pairs
};
// Fewer pairs in a process zone make the traction in it, and with it the load of a local solution, depend on the mesh.
inline constexpr double resolving_pairs = 3.0;
// Mean distance of the initially adhering pairs of an interface; 0: none adheres.
double pair_spacing(const Problem& problem, std::int64_t interface);
ProcessZone predicted_process_zone(const Problem& problem, std::int64_t interface);
// The largest peak tractions, normal and tangential, at which the predicted zone of that mode is at least `length`
// long; 0: no softening law.
std::array<double, 2> resolved_strengths(const Problem& problem, std::int64_t interface, double length);

// The least thickness of the bodies beside an interface, as ProcessZone has it; 0: none has cells and a material.
double arm_thickness(const Problem& problem, std::int64_t interface);
// Returns those bodies beside an interface that have cells and a material.
std::vector<std::int32_t> elastic_bodies(const Problem& problem, std::int64_t interface);

}  // namespace delam
