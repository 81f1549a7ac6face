// SPDX-License-Identifier: BSD-3-Clause
// Checks that the pairs of an interface resolve the process zones of its cracks: by a prediction before an analysis,
// and by the rows of the history after it.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "model/library/model.hpp"
#include "result/history/rows.hpp"

namespace cli {

// One line for each interface with a softening law: predicted process zone and the pairs in it.
std::vector<std::string> process_zones(const Model& model);
// True if a law of an interface softens, so that cracks have process zones.
bool any_softens(const Model& model, const Scene& scene);
// Numbers for a law that are better than its own.
struct Advice {
    std::string law;
    std::vector<std::string> interfaces;  // with this law
    std::vector<std::pair<std::string, double>> keys;
    std::string reason;
};
// Strengths where the process zone has fewer than 3 pairs, and stiffnesses where they are far from what layers need.
std::vector<Advice> advice(const Model& model, const Scene& scene);
// Steps in which a crack grew with fewer than 3 pairs in its process zone, before and after. None for energetic
// solutions and for scenes whose laws do not soften.
std::vector<std::int64_t> unresolved_steps(const Rows& rows, const Model& model, const Scene& scene);
std::string unresolved_line(const std::vector<std::int64_t>& steps);
// The step in which the energy release rate of a crack exceeds the largest toughness of the scene most; times 0: it
// does so in none by more than a quarter, the solution is energetic, or no law has a toughness.
struct Waiting {
    std::int64_t step = 0;
    double time = 0, rate = 0, toughness = 0;
    double times = 0;
};
Waiting waiting_of(const Rows& rows, const Model& model, const Scene& scene);
// "" where no crack waits.
std::string waiting_line(const Waiting& waiting, const Scene& scene);
// Pairs that came apart one by one at one load, because the mesh does not resolve the process zone.
struct Pops {
    std::int64_t pairs = 0;
    double released = 0, work = 0;
    bool softening = true;
};
// softening: a law of the scene softens.
Pops pops_of(const Rows& rows, bool softening);
// "" where they released little.
std::string pops_line(const Pops& pops);

}  // namespace cli
