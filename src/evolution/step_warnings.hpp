// SPDX-License-Identifier: BSD-3-Clause
// What makes a step doubtful: its two-sided energy estimate, and a ledger that does not close.
#pragma once

#include "base/monitor.hpp"
#include "evolution/increment/state.hpp"
#include "scene/options.hpp"

namespace delam {

// Tells the host (log level 1) of the first step of each kind.
class StepWarnings {
public:
    void judge(const State& before, const State& after, const Options& options, const Monitor& monitor);

private:
    bool told_of_estimate_ = false;
    bool told_of_ledger_ = false;
};

}  // namespace delam
