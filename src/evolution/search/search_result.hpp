// SPDX-License-Identifier: BSD-3-Clause
// Result of a search.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "evolution/increment/damage_step.hpp"
#include "evolution/search/growth_profile.hpp"

namespace delam {

// A candidate above the step's state by no more than this part of what it dissipates may relax below it. (Measured by
// verify/bench/constants.py with verify/cases/search/energetic.py: half and twice end in the same states, with 0.52 to
// 1.38 times the solves.)
inline constexpr double promising = 0.5;

struct Candidate {
    std::vector<double> adhesion;  // [pairs]
    PairMixities mixity;           // [pairs] with which it was recorded
    double incremental = 0.0;      // I, F L
    // [pairs] the part of D that a pair has at least, where no sample has shown its mixity at any, F L; empty: the
    // mixities do not follow the iterates.
    std::vector<double> least{};
};

// True if all pairs that a candidate debonds have the same toughness.
bool same_toughness(const PairLaws& pairs, const Candidate& candidate, std::span<const double> from);
// True if a candidate debonds no more pairs than soften already. The step itself has compared such states.
bool within_zone(std::span<const double> candidate, std::span<const double> from);

// The energies that pairs dissipate along a path of equilibria, F L.
struct PathCosts {
    std::vector<double> cost;          // [pairs]
    std::vector<std::uint8_t> broken;  // [pairs] 1: the path has taken all of the toughness
};

// The positions of a front that a sweep has not sampled, with the other fronts in their places.
struct LeftOut {
    // At this or a larger number of rings, up to the next sample, E less the energy before is no less, F L.
    struct Place {
        std::size_t rings;
        double energy;
    };
    double begun = 0.0;         // D that no path changes, F L
    std::vector<double> least;  // [pairs] Candidate::least of the base
    std::vector<std::vector<std::int64_t>> ring;
    std::vector<std::vector<double>> ring_least;  // [rings][pairs of the ring]
    std::vector<Place> places;

    // Returns a lower bound of I. A pair that the path has broken costs what it dissipates there.
    double bound(const PathCosts& path) const;
};

struct SearchResult {
    std::vector<Candidate> starts;  // to minimise from, lowest first
    std::int64_t candidates = 0;
    double lowest = std::numeric_limits<double>::infinity();  // I of all candidates
    std::vector<LeftOut> left_out;                            // of each sweep
    double error = 0.0;  // by which the energy of a candidate may be too high, F L; the bound takes it into account
    std::string words;
    std::vector<GrowthProfile> profiles;  // of fronts and new cracks, from the state before the step
    std::vector<double> energies;         // for the search of the next step (State::search_energies)

    // Returns what no candidate that was left out lies below; infinite: there is none.
    double bound(const PathCosts& path) const;
};

}  // namespace delam
