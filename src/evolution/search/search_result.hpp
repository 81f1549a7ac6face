// SPDX-License-Identifier: BSD-3-Clause
// Result of a search.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "evolution/search/growth_profile.hpp"

namespace delam {

// A candidate above the step's state by no more than this part of what it dissipates may relax below it. (Measured by
// verify/bench/constants.py with verify/cases/search/energetic.py: half and twice end in the same states, with 0.52 to
// 1.38 times the solves.)
inline constexpr double promising = 0.5;

struct Candidate {
    std::vector<double> adhesion;  // [pairs]
    std::vector<double> mixity;    // [pairs] with which it was recorded
    double incremental = 0.0;      // I, F L
    double least_cost = 0.0;       // D is no less at any mixities of the pairs whose mixity no sample has shown, F L
};

struct SearchResult {
    std::vector<Candidate> starts;  // to minimise from, lowest first
    std::int64_t candidates = 0;
    // Lowest I of all candidates, and what no candidate that was left out lies below; infinite: none.
    double lowest = std::numeric_limits<double>::infinity();
    double bound = std::numeric_limits<double>::infinity();
    double error = 0.0;  // by which the energy of a candidate may be too high, F L; the bound takes it into account
    std::string words;
    std::vector<GrowthProfile> profiles;  // of fronts and new cracks, from the state before the step
    std::vector<double> energies;         // for the search of the next step (State::search_energies)
};

}  // namespace delam
