// SPDX-License-Identifier: BSD-3-Clause
// What a scene needs and what was left out, as data: each with its reason, what it costs and what the decision saves.
#pragma once

#include <string>
#include <vector>

namespace delam {

struct PlanItem {
    std::string subject;   // "contact of interface 0"
    std::string decision;  // "used" or "left out"
    std::string reason;
    double cost = 0.0;    // predicted, of what is used; 0 for what is left out
    double saving = 0.0;  // predicted, against the other decision
    std::string unit;     // of both
};

// One line each: subject: decision, reason (cost ..., saves ...)
std::string plan_in_words(const std::vector<PlanItem>& items);

}  // namespace delam
