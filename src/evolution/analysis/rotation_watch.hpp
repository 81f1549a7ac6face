// SPDX-License-Identifier: BSD-3-Clause
// Watches an analysis with small rotations for the step in which these leave out too much (kinematics = auto).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

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

    // Says for which loads, contact and debonded share of each interface the ratio was computed last.
    struct Known {
        double ratio;
        std::vector<double> theta;
        std::vector<std::uint8_t> closed;
        std::vector<double> debonded;
    };
    std::optional<Known> known_;
};

}  // namespace delam
