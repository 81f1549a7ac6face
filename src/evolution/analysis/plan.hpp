// SPDX-License-Identifier: BSD-3-Clause
// The decisions that an analysis takes for a scene, as data: each item with its reason, its cost and its saving.
#pragma once

#include <string>
#include <vector>

#include "base/monitor.hpp"
#include "scene/problem.hpp"

namespace delam {

struct PlanItem {
    std::string subject;   // "contact of interface 0"
    std::string decision;  // "used" or "left out"
    std::string reason;
    double cost = 0.0;    // predicted, of used items; 0 for items left out
    double saving = 0.0;  // predicted, compared with the other decision
    std::string unit;     // of both
};

class Solver;
std::vector<PlanItem> plan_of(const Solver& solver);

// The plan of an analysis that has not begun.
struct Forecast {
    std::vector<PlanItem> plan;
    double setup = 0.0;   // s, nominal, of the factorisations before the first step of each stage
    double memory = 0.0;  // bytes at the peak of an analysis
};
// Checks, assembles and analyses, but factors nothing.
Forecast forecast(const Problem& problem, Monitor& monitor);

// One line each: subject: decision, reason (cost ..., saves ...)
std::string plan_in_words(const std::vector<PlanItem>& items);

}  // namespace delam
