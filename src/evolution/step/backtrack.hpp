// SPDX-License-Identifier: BSD-3-Clause
// Backtracking by the two-sided energy estimate (Zeman, Kruzik, Gruber, PANM 15 (2010), "Backtracking algorithm";
// Mielke, Roubicek, Zeman, CMAME 199 (2010) 1242-1253).
//
// If the lower bound of step k fails, state k has less energy at the time of step k - 1 than state k - 1 has. Step k -
// 1 was then not minimal. It is computed again from state k - 2, from both starts, and the lowest of all states is
// kept. Only the lower bound decides (a minimisation from z_{k-1} always satisfies the upper one), with the mixity of
// step k - 2, because the bound holds for what was minimised. Each return lowers the incremental energy of the step to
// which it returns, so the algorithm terminates; a return that finds nothing lower is the last.
#pragma once

#include <cstdint>
#include <map>
#include <span>

#include "evolution/step/stepper.hpp"

namespace delam {

// Committed steps, oldest first; the last one is the present state; some of them replaced.
class Chain {
public:
    Chain(std::span<const State> past, const State& last) : past_(past), last_(last) {}
    std::int64_t first() const { return past_.empty() ? last_.step : past_.front().step; }
    const State& at(std::int64_t step) const;
    void revise(State state) { revised_.insert_or_assign(state.step, std::move(state)); }
    std::map<std::int64_t, State>& revised() { return revised_; }

private:
    std::span<const State> past_;
    const State& last_;
    std::map<std::int64_t, State> revised_;
};

// Computes the step after the chain's last, at `time`, and revises the chain if the estimate requires it.
// history.backtracks is the number of returns.
Stepper::Result backtracked_step(Stepper& stepper, Chain& chain, std::int64_t last_step, double time,
                                 const Options& options);

// True if an analysis keeps earlier steps to return to.
bool keeps_past(const Options& options);

}  // namespace delam
