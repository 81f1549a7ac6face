// SPDX-License-Identifier: BSD-3-Clause
// Warns in the host's log about the steps of an analysis, once for each kind of warning.
#pragma once

#include <string>

#include "base/monitor.hpp"
#include "evolution/observe/observer.hpp"
#include "scene/problem.hpp"

namespace delam {

class Warnings {
public:
    // The monitor must outlive them.
    Warnings(const Problem& problem, Monitor& monitor);
    // Warns of a step whose energy lies outside its two-sided estimate, and of a ledger that does not close.
    void judge_ledger(const State& after, const Options& options);
    // Warns of a front that advanced with too few pairs in its process zone.
    void judge_front(const Observer& observer, const State& before, const State& after);
    // Warns of cells whose rotation, in rad, is large for strains that are linear in the displacements.
    void judge_rotation(const State& state, double largest);
    // Warns of nodal forces that are poorly balanced.
    void report_balance(const std::string& what);

private:
    Monitor& monitor_;
    double least_ = 0.0;
    bool told_of_estimate_ = false;
    bool told_of_ledger_ = false;
    bool told_of_front_ = false;
    bool told_of_rotation_ = false;
    bool told_of_balance_ = false;
};

}  // namespace delam
