// SPDX-License-Identifier: BSD-3-Clause
// One analysis of a flexure specimen by the library, with options that it may not have: the recorded energies of every
// step.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "flexure.hpp"

namespace harness {

// Options by key, set in this order.
struct Choice {
    std::vector<std::pair<std::string, std::string>> texts;
    std::vector<std::pair<std::string, double>> numbers;
};

// Energies in J/m, cumulative or of the step. Values that the library does not have are NaN.
struct Record {
    double load = 0.0;
    double stored_bulk = 0.0, stored_interface = 0.0, dissipated = 0.0, work = 0.0;
    double upper = 0.0, increment = 0.0;  // of the step
    double front = 0.0, debonded = 0.0;   // m: advance; length with zeta <= 1e-3
    double am_iterations = 0.0, newton_solves = 0.0, displacement_solves = 0.0, candidates = 0.0, backtracks = 0.0;
    double released = 0.0;
    bool converged = true;

    double total() const { return stored_bulk + stored_interface + dissipated; }
    // Energy released by a jump in this step: that of the previous state at the end of the step less that of the new
    // state.
    double drop() const { return upper - increment; }
};

struct Analysis {
    std::vector<Record> steps;
    Record spent;             // counts of all calls, including steps that were replaced later
    double first_jump = 0.0;  // m, load of the first located jump; NaN: none
    std::string refused;      // the library's message if it does not know an option; then there are no steps
    // Largest |stored + dissipated - work|.
    double defect() const;
};

Analysis run(const reference::Flexure& data, int steps, const Choice& choice);

// "skipped: " and the reason, without the list of known values.
std::string skipped(const std::string& refused);

}  // namespace harness
