// SPDX-License-Identifier: BSD-3-Clause
// One march by one method, timed in its parts, from the mesh in memory to the last step.
#pragma once

#include <optional>

#include "baseline.hpp"
#include "scenes.hpp"
#include "stats.hpp"

namespace bench {

// One way of marching. nullptr: whatever the library does by itself; without a reduction: the baseline.
struct Method {
    const char* key;
    const char* reduction;
    const char* minimisation;
    const char* solution = nullptr;
    const char* backtracking = nullptr;
};
// The four methods of the table `march`: baseline, feti, condensed, accelerated.
const std::vector<Method>& methods();
// The three of the table `energetic`, all accelerated: local, backtracking, energetic.
const std::vector<Method>& concepts();
const Method& find_method(const std::string& key);  // of either; throws reference::Failure

// Options of a method, left out where the library cannot do anything else yet: an old library knows only FETI and plain
// alternation, so asking for these is no refusal. nullopt: the library does not know the method; `refusal` says why.
std::optional<Choice> resolve(Stage& stage, const Method& method, double delta, std::string& refusal);

// Declares the scene and marches; stops when `cap` seconds are over (March::capped). Library methods only.
// `at_step` is called after each commit, outside the clock.
March run_library(Stage& stage, const Choice& choice, double cap,
                  const std::function<void(reference::Solver&, int)>& at_step = {});
// The same for the baseline. `pricing` > 0: stops once that many factorisations were timed.
struct BaselineTimes {
    std::vector<double> factor, solve;  // s, of single systems
};
March run_baseline(Stage& stage, const BaselineOptions& options, double cap, std::int64_t pricing = 0,
                   BaselineTimes* times = nullptr, const std::function<void(Baseline&, int)>& at_step = {});

// Sums of the counts, and the history as columns.
Json counts(const March& march);
Json history(const March& march);

}  // namespace bench
