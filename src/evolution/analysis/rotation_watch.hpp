// SPDX-License-Identifier: BSD-3-Clause
// Watches an analysis with small rotations for the step in which these leave out too much (kinematics = auto).
#pragma once

#include <string>

#include "evolution/observe/observer.hpp"

namespace delam {

class RotationWatch {
public:
    // Returns what small rotations leave out of a state that the observer shows, in words; empty: nothing that counts.
    std::string judge(Observer& observer, const State& state);

private:
    // Returns the stresses over those at which the bodies buckle; of a state that differs little from the one for which
    // they were computed last, an estimate.
    double buckling_ratio(Observer& observer, const State& state);

    // These belong to the state for which the ratio was computed last.
    bool known_ = false;
    double ratio_ = 0.0, energy_ = 0.0, debonded_ = 0.0;
};

}  // namespace delam
