// SPDX-License-Identifier: BSD-3-Clause
// The jumps of the state that the solver recorded: jumps.csv, one row each, and closing lines.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/library/model.hpp"

namespace cli {

struct Jump {
    std::int64_t step = 0;
    double before = 0;
    double time = 0;
    std::vector<double> loads_before;  // factor of each pattern at `before`
    std::vector<double> loads;         // and at `time`
    std::vector<double> reaction_before, reaction_after;
    double stored = 0;
    double dissipated = 0;
    double released = 0;
    double debonded = 0;
    std::int64_t interface = 0;
    std::int64_t first = 0;
    std::int64_t last = 0;
    std::string name;  // of the interface
};

// Returns the jumps up to the present state, ordered by time. The state that a resumed run loads contains those before
// it.
std::vector<Jump> jumps_of(const Model& model, const delam_solver* solver, const Scene& scene);
// True if jumps.csv is written: there is a jump, or jumps are located (option jump_tolerance > 0).
bool writes_jumps(const std::vector<Jump>& jumps, const delam_solver* solver);
// Header and rows. The columns of the loads have the names of those of history.csv.
std::string jumps_text(const std::vector<Jump>& jumps, const Scene& scene);
// The jumps that get a line of their own: those that release most energy, at most ten, ordered by time.
std::vector<Jump> largest_jumps(const std::vector<Jump>& jumps);
// A line for each of these, and one for all others.
std::vector<std::string> jump_lines(const std::vector<Jump>& jumps, const Scene& scene, double work);

}  // namespace cli
