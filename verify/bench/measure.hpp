// SPDX-License-Identifier: BSD-3-Clause
// Single measurements of the tables `march` and `energetic`; each runs in a process of its own (child.hpp).
// `cap`: seconds that a march may take.
#pragma once

#include <string>

#include "march.hpp"

namespace bench {

// All methods and the LSE by turns, `repeat` rounds: times, counts, histories, agreement (series.cpp).
Json measure_series(const std::string& scene, int repeat, double cap);
// Peak memory of one method, or of one monolithic factorisation ("lse") (memory.cpp).
Json measure_memory(const std::string& scene, const std::string& method, double cap);
// Histories of all methods at a tolerance delta, compared (agreement.cpp).
Json measure_agreement(const std::string& scene, double delta, double cap);
// Is every method's end state a critical point? (critical.cpp)
Json measure_critical(const std::string& scene, double cap);
// Local, backtracked and energetic march and the LSE by turns, `repeat` rounds: times, counts, the jump, what the
// search left open (energetic_series.cpp).
Json measure_concepts(const std::string& scene, int repeat, double cap);

// Largest relative differences of two marches over their common steps: reaction over the largest reaction, energies
// over the largest total energy.
Json compare(const March& a, const March& b);

// Predicted cost of the baseline from the counts of another march by plain alternation, whose iterates are the same,
// and from times of single systems.
struct Price {
    double seconds = 0.0;
    std::int64_t factorisations = 0;
    std::int64_t solves = 0;
};
Price price(const March& counted, double factor_seconds, double solve_seconds);

// One line on stderr.
void progress(const std::string& text);

}  // namespace bench
