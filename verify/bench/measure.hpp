// SPDX-License-Identifier: BSD-3-Clause
// Single measurements of the tables `analysis`, `energetic` and `side-by-side`; each runs in a separate process
// (child.hpp). `cap`: maximal seconds of an analysis.
#pragma once

#include <limits>
#include <string>

#include "analysis.hpp"
#include "lse.hpp"

namespace bench {

inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// What the JSON of a series begins with: the scene, its sizes, the machine (series.cpp).
Json facts_of(const Stage& stage, Lse& lse, const std::string& scene, double cap);
// All methods and the LSE in turn, `repeat` rounds: times, counts, histories, agreement (series.cpp).
Json measure_series(const std::string& scene, int repeat, double cap);
// Peak memory of one method, or of one monolithic factorisation ("lse") (memory.cpp).
Json measure_memory(const std::string& scene, const std::string& method, double cap);
// Compares the histories of all methods at a tolerance delta (agreement.cpp).
Json measure_agreement(const std::string& scene, double delta, double cap);
// Checks that every method's end state is a critical point (critical.cpp).
Json measure_critical(const std::string& scene, double cap);
// Local, backtracked and energetic analysis and the LSE in turn, `repeat` rounds: times, counts, the jump, gap and
// margin of the search (energetic_series.cpp).
Json measure_concepts(const std::string& scene, int repeat, double cap);
#ifdef DELAM_SCENE_FILES
// An analysis of a scene file, from the mesh in memory: seconds of the clock and of the processors
// (side_by_side_table.cpp).
Json measure_analysis(const std::string& path, const std::vector<std::string>& settings);
#endif

// Largest relative differences of two analyses over their common steps: reaction relative to the largest reaction,
// energies relative to the largest total energy.
Json compare(const Analysis& a, const Analysis& b);

// Predicted cost of the baseline, from the counts of another analysis by plain alternate minimisation, whose iterates
// are the same, and from times of single linear systems.
struct Price {
    double seconds = 0.0;
    std::int64_t factorisations = 0;
    std::int64_t solves = 0;
};
Price price(const Analysis& counted, double factor_seconds, double solve_seconds);

// Prints one line on stderr.
void progress(const std::string& text);

}  // namespace bench
