// SPDX-License-Identifier: BSD-3-Clause
// What makes a step doubtful: its two-sided energy estimate, and a ledger that does not close.
#pragma once

#include "base/monitor.hpp"
#include "evolution/increment/state.hpp"
#include "scene/problem.hpp"

namespace delam {

// Tells the host (log level 1) of the first step of each kind. An energy counts from 2 % of what it takes to debond
// all interfaces on: the first steps, which store little, are not precise to more.
class StepWarnings {
public:
    explicit StepWarnings(const Problem& problem);
    void judge(const State& after, const Options& options, const Monitor& monitor);

private:
    double least_ = 0.0;
    bool told_of_estimate_ = false;
    bool told_of_ledger_ = false;
};

}  // namespace delam
