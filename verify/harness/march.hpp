// SPDX-License-Identifier: BSD-3-Clause
// One analysis of a flexure specimen by the library, with options that it may not have: the booked energies of every
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
    double load = 0.0, reaction = 0.0;
    double stored_bulk = 0.0, stored_interface = 0.0, dissipated = 0.0, work = 0.0;
    double stored_interface_slides = 0.0, dissipated_slides = 0.0;
    double lower = 0.0, upper = 0.0, increment = 0.0, increment_lower = 0.0;  // of the step
    double front = 0.0, debonded = 0.0;                                       // m: advance; length with zeta <= 1e-3
    double am_iterations = 0.0, newton_solves = 0.0, displacement_solves = 0.0, candidates = 0.0, backtracks = 0.0;
    double jumps = 0.0, released = 0.0;
    bool converged = true;
    std::vector<double> adhesion;  // [pairs], if requested

    double total() const { return stored_bulk + stored_interface + dissipated; }
    double total_slides() const { return stored_bulk + stored_interface_slides + dissipated_slides; }
    // Energy released by a jump in this step: that of the previous state at the end of the step less that of the new
    // state.
    double drop() const { return upper - increment; }
    // Violation of the two bounds, > 0 if violated, relative to the tolerance's scale max(|E|, work).
    double lower_violation() const;
    double upper_violation() const;
};

struct March {
    std::vector<Record> steps;
    Record spent;             // counts of all calls, including steps that were replaced later
    double first_jump = 0.0;  // m, load of the first located jump; NaN: none
    std::string refused;      // the library's message if it does not know an option; then there are no steps
    double sum(double Record::*member) const;
    // Largest |stored + dissipated - work|, in either ledger.
    double defect() const;
    double defect_slides() const;
};

March run(const reference::Flexure& data, int steps, const Choice& choice, bool keep_adhesion = false);

// "skipped: " and the reason, without the list of known values.
std::string skipped(const std::string& refused);

// A curve over time, linear between its points; constant spacing, from value 0 at time 0.
double at(const std::vector<double>& values, double part);

}  // namespace harness
