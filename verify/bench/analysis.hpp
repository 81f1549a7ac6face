// SPDX-License-Identifier: BSD-3-Clause
// One analysis by one method, timed in parts, from the mesh in memory to the last step.
#pragma once

#include <optional>

#include "baseline.hpp"
#include "scenes.hpp"
#include "stats.hpp"

namespace bench {

// One method. Options that are nullptr keep the library's default; an empty reduction means the baseline.
struct Method {
    const char* key;
    const char* reduction;
    const char* minimisation;
    const char* solution = nullptr;
    const char* backtracking = nullptr;
};
// The four methods of the table `analysis`: baseline, feti, condensed, accelerated.
const std::vector<Method>& methods();
// The three of the table `energetic`, all accelerated: local, backtracking, energetic.
const std::vector<Method>& concepts();
const Method& find_method(const std::string& key);  // of either; throws reference::Failure

// Options of a method. An option is omitted if the library has no alternative: an old library knows only FETI and plain
// alternate minimisation, and runs both without being asked. nullopt: the library does not know the method; `refusal`
// has its message.
std::optional<Choice> resolve(Stage& stage, const Method& method, double delta, std::string& refusal);

// Declares the scene and runs the analysis; stops after `cap` seconds (Analysis::capped). Library methods only.
// `at_step` is called after each commit and is not timed.
Analysis run_library(Stage& stage, const Choice& choice, double cap,
                     const std::function<void(reference::Solver&, int)>& at_step = {});
// The same for the baseline. `pricing` > 0: stops after that many timed factorisations.
struct BaselineTimes {
    std::vector<double> factor, solve;  // s, of single linear systems
};
Analysis run_baseline(Stage& stage, const BaselineOptions& options, double cap, std::int64_t pricing = 0,
                      BaselineTimes* times = nullptr, const std::function<void(Baseline&, int)>& at_step = {});

// Sums of the counts, and the history in columns.
Json counts(const Analysis& analysis);
Json history(const Analysis& analysis);

}  // namespace bench
