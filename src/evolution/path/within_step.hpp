// SPDX-License-Identifier: BSD-3-Clause
// The evolution within a load step that was followed in parts at the load of its end. Bodies, springs and contact
// answer an a-fold load with a-fold displacements. The energy of each state on the path is therefore known at every
// load of the step, E(a) = a^2 e + g with the gradient energy g. The part from one state to the next can happen once
// its drop of energy equals the energy that it dissipates,
//
//   a_c^2 (e_{i-1} - e_i) + g_{i-1} - g_i = D_i,
//
// and, because the load does not fall, it happens at a_i = max(a_{i-1}, a_c). Where a_c falls along the path, the load
// is constant and the state jumps: the drop beyond D_i is released. Between the parts the load does work at the state
// that the path has reached.
#pragma once

#include <span>
#include <vector>

#include "evolution/increment/state.hpp"

namespace delam {

// A state of the path. The members are, in this order: the energy at the load of the end of the step, F L; the gradient
// energy in it; the energy dissipated until then. Then follow sum w (1 - zeta) of each interface, L or L2, and
// dE/dtheta of each pattern at the load of the end.
struct PathPoint {
    double energy = 0.0, gradient = 0.0, dissipated = 0.0;
    std::vector<double> debonded, conjugate;
};

struct WithinStep {
    double work = 0.0;      // of the step, F L
    double released = 0.0;  // F L, >= 0
    JumpWithin jump;        // of the longest advance
};

// points: the state before the step first. begin: the load before the step over that of its end, 0 <= begin <= 1.
// elsewhere: the path began at a state that is not that before the step, so that its first part is a jump.
WithinStep within_step(std::span<const PathPoint> points, double begin, bool elsewhere);

}  // namespace delam
