// SPDX-License-Identifier: BSD-3-Clause
// The results of an analysis: the same columns for the baseline and the library.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace bench {

// One load step. Energies as in delam_solver_value: stored energies of the state, `dissipated` cumulative.
struct StepRecord {
    double time = 0.0;
    double load = 0.0;      // factor of the first pattern
    double reaction = 0.0;  // conjugate of the first pattern
    double stored_bulk = 0.0;
    double stored_interface = 0.0;
    double dissipated = 0.0;
    double damage_change = 0.0;
    std::int64_t am_iterations = 0;
    std::int64_t displacement_solves = 0;
    std::int64_t contact_iterations = 0;  // active-set steps: linear systems solved
    std::int64_t linear_iterations = 0;   // Krylov iterations
    std::int32_t status = 0;
    double seconds = 0.0;  // of this step, by the library
};

struct Analysis {
    std::vector<StepRecord> steps;
    double setup = 0.0;      // s, problem and its checks
    double factor = 0.0;     // s, everything that is done once: assembly, analysis, condensation, first factors
    double iterate = 0.0;    // s, the steps
    double processor = 0.0;  // s, processor time of all three, all threads; only for the library
    double bulk_factorisations = -1.0;  // -1: not counted by this library
    double field_recoveries = -1.0;
    std::string plan;
    bool capped = false;  // stopped by the time limit; the steps so far are kept

    double total() const { return setup + factor + iterate; }
};

}  // namespace bench
